// SPDX-License-Identifier: Apache-2.0
// Lightmaps on the surfaces of a scene (docs/lightmaps.md): a scene that says where each mesh lies in
// the pages, and pages, which may change.
import type {Lightmaps} from 'tetralight';
import * as three from 'three';
import type {GLTF} from 'three/addons/loaders/GLTFLoader.js';

import {lightByLightmap} from './shaders';

/** Where a mesh lies in the pages: uv_page = uv · scale + offset. */
export interface LightmapPlace {
    mesh: three.Mesh;
    page: number;
    channel: number;  // of its UVs
    scale: number[];
    offset: number[];
}

interface GltfNode {
    extras?: {lightmap_rectangle?: {page: number; texCoord: number; scale: number[]; offset: number[]}};
    extensions?: {MX_lightmap?: {lightMapTexture: {index: number; texCoord?: number};
                                 scale?: number[]; offset?: number[]}};
}

interface GltfTexture {
    extensions?: Record<string, unknown>;
}

/** The place that a node of `tetralight unwrap` or `export` says; `firstPage` is the texture of page 0. */
export function placeOf(node: GltfNode, firstPage: number): Omit<LightmapPlace, 'mesh'> | null {
    const rectangle = node.extras?.lightmap_rectangle;
    if (rectangle !== undefined) {
        const {page, texCoord, scale, offset} = rectangle;
        return {page, channel: texCoord, scale, offset};
    }
    const lightmap = node.extensions?.MX_lightmap;
    if (lightmap === undefined) return null;
    const {lightMapTexture: {index, texCoord = 1}, scale = [1, 1], offset = [0, 0]} = lightmap;
    return {page: index - firstPage, channel: texCoord, scale, offset};
}

/** The meshes of a scene that have a place in pages. */
export function placesOf(gltf: GLTF): LightmapPlace[] {
    const {json, associations} = gltf.parser as unknown as {
        json: {nodes?: GltfNode[]; textures?: GltfTexture[]};
        associations: Map<object, {nodes?: number} | undefined>;
    };
    const firstPage = (json.textures ?? []).findIndex(({extensions}) => extensions?.MX_texture_rgbm !== undefined);
    const places: LightmapPlace[] = [];
    gltf.scene.traverse(object => {
        const index = associations.get(object)?.nodes;
        const place = index === undefined ? null : placeOf(json.nodes![index], firstPage);
        if (place === null) return;
        // The mesh of a node that also has a camera or a light is a child without a node of its own.
        const own = [object, ...object.children.filter(child => associations.get(child)?.nodes === undefined)];
        for (const mesh of own) if (mesh instanceof three.Mesh) places.push({mesh, ...place});
    });
    return places;
}

/** The lightmaps of a scene that is shown. */
export class SceneLightmaps {
    private textures: three.DataTexture[] = [];
    private scale = 1;
    private isUsed = true;

    /** `light` gives a material the light of probes, which it has without lightmaps. */
    constructor(private readonly places: LightmapPlace[], private readonly light: (material: three.Material) => void) {}

    get hasPages(): boolean {
        return this.textures.length > 0;
    }

    /** Where one of these meshes lies in the pages, or null. */
    placeOf(meshes: readonly three.Mesh[]): LightmapPlace | null {
        return this.places.find(({mesh}) => meshes.includes(mesh)) ?? null;
    }

    setPages({pageSize, pageCount, scale, irradiance}: Lightmaps): void {
        this.dispose();
        this.scale = scale;
        const length = 4 * pageSize * pageSize;
        this.textures = Array.from({length: pageCount}, (_, i) => {
            const page = irradiance.subarray(i * length, (i + 1) * length) as Uint16Array<ArrayBuffer>;
            const texture = new three.DataTexture(page, pageSize, pageSize, three.RGBAFormat, three.HalfFloatType);
            texture.minFilter = texture.magFilter = three.LinearFilter;
            return texture;
        });
        this.apply();
    }

    /** Whether surfaces show lightmaps, or the light of probes. */
    use(isUsed: boolean): void {
        if (isUsed === this.isUsed) return;
        this.isUsed = isUsed;
        this.apply();
    }

    dispose(): void {
        for (const {mesh} of this.places) lambertOf(mesh).lightMap?.dispose();
        for (const texture of this.textures) texture.dispose();
        this.textures = [];
    }

    private apply(): void {
        for (const place of this.places) {
            const material = lambertOf(place.mesh);
            const page = this.isUsed ? this.textures[place.page] : undefined;
            if (page === undefined) showProbes(material, this.light);
            else showPage(material, page, place, this.scale);
        }
    }
}

const lambertOf = (mesh: three.Mesh) => mesh.material as three.MeshLambertMaterial;

function showProbes(material: three.MeshLambertMaterial, light: (material: three.Material) => void): void {
    material.lightMap?.dispose();
    material.lightMap = null;
    light(material);
    material.needsUpdate = true;
}

/** Each mesh has a rectangle of its own; the page is uploaded once. */
function showPage(material: three.MeshLambertMaterial, page: three.Texture, place: LightmapPlace, scale: number): void {
    material.lightMap?.dispose();
    material.lightMap = page.clone();
    material.lightMap.channel = place.channel;
    material.lightMap.repeat.fromArray(place.scale);
    material.lightMap.offset.fromArray(place.offset);
    material.lightMapIntensity = scale;
    lightByLightmap(material);
    material.needsUpdate = true;
}
