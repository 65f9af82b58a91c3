// SPDX-License-Identifier: Apache-2.0
// Lightmaps on the static objects of a scene that `tetralight unwrap`, `lightmap --unwrapped` or `export` wrote:
//
//     const gltf = await new GLTFLoader().loadAsync('uv1.glb');
//     const lightmaps = new SceneLightmaps(readLightmaps(buffer), gltf.scene);
import * as three from 'three';

import {argumentError} from '../error.js';
import type {LayerWeights} from '../layers.js';
import {lightmapIrradiance, Lightmaps} from '../lightmaps.js';
import {kNone} from '../section_file.js';

/** Where a mesh lies in the pages: UVs of the page are UVs of the mesh · scale + offset. */
interface Place {
    page: number;
    channel: number;  // of the UVs of the mesh
    scale: number[];
    offset: number[];
}

type Mesh = three.Mesh<three.BufferGeometry, three.Material | three.Material[]>;

interface LightmappedMesh extends Place {
    mesh: Mesh;
    before: three.Material | three.Material[];
}

/** What GLTFLoader keeps of a node. */
interface UserData {
    lightmap_rectangle?: {page: number; texCoord: number; scale: number[]; offset: number[]};
    gltfExtensions?: {
        MX_lightmap?: {lightMapTexture: {index: number; texCoord?: number}; scale?: number[]; offset?: number[]};
    };
}

const kLargestHalf = 65504;

/** Materials with a `lightMap`. */
const hasLightmap = (material: three.Material): material is three.MeshStandardMaterial => 'lightMap' in material;

/** Gives meshes copies of their materials with `lightMap`; all other light stays. */
export class SceneLightmaps {
    private readonly placed: LightmappedMesh[];
    private readonly pages: three.DataTexture[];

    /**
     * Throws if no mesh of the scene has a rectangle, or if one is not one of the file: the scene was not unwrapped, or for other
     * lightmaps.
     */
    constructor(private readonly lightmaps: Lightmaps, scene: three.Object3D) {
        this.placed = placedMeshes(scene);
        if (this.placed.length === 0 && lightmaps.rectangles.some(({page}) => page !== kNone)) {
            throw argumentError('scene', 'has no mesh with a place in the lightmaps: load the scene that `tetralight lightmap ' +
                                         '--unwrapped`, `unwrap` or `export` wrote');
        }
        checkPlaces(this.placed, lightmaps);
        const {pageSize: size, pageCount, irradiance} = lightmaps;
        const length = 4 * size * size;
        this.pages = Array.from({length: pageCount}, (_, i) => {
            const page = irradiance.slice(i * length, (i + 1) * length);
            const texture = new three.DataTexture(page, size, size, three.RGBAFormat, three.HalfFloatType);
            texture.minFilter = texture.magFilter = three.LinearFilter;
            texture.needsUpdate = true;
            return texture;
        });
        for (const place of this.placed) place.mesh.material = this.lightmapped(place);
    }

    /** Meshes with a lightmap: probes need not light these. */
    get meshes(): three.Mesh[] {
        return this.placed.map(({mesh}) => mesh);
    }

    /** Changes the weights of layers of the bake; those that are not named are as they were baked. */
    setWeights(weights: LayerWeights): void {
        const light = lightmapIrradiance(this.lightmaps, weights);
        let brightest = 0;
        for (const value of light) brightest = Math.max(brightest, value);
        let {scale} = this.lightmaps;
        while (brightest > kLargestHalf * scale) scale *= 2;
        const length = light.length / this.pages.length;
        this.pages.forEach((texture, i) => {
            const page = texture.image.data as Uint16Array;
            for (let k = 0; k < length; ++k) page[k] = three.DataUtils.toHalfFloat(light[i * length + k] / scale);
            texture.needsUpdate = true;
        });
        for (const material of this.materials()) {
            material.lightMapIntensity = scale;
            material.lightMap!.needsUpdate = true;
        }
    }

    /** Gives meshes the materials back that they had. */
    dispose(): void {
        for (const material of this.materials()) {
            material.lightMap?.dispose();
            material.dispose();
        }
        for (const {mesh, before} of this.placed) mesh.material = before;
        for (const page of this.pages) page.dispose();
        this.placed.length = 0;
    }

    private materials(): three.MeshStandardMaterial[] {
        return this.placed.flatMap(({mesh}) => [mesh.material].flat().filter(hasLightmap));
    }

    private lightmapped({mesh, page, channel, scale, offset}: LightmappedMesh): three.Material | three.Material[] {
        const copies = [mesh.material].flat().map(material => {
            if (!hasLightmap(material)) return material;
            const copy = material.clone();
            // A rectangle of its own; the texels are uploaded once a page.
            copy.lightMap = this.pages[page].clone();
            copy.lightMap.channel = channel;
            copy.lightMap.repeat.fromArray(scale);
            copy.lightMap.offset.fromArray(offset);
            copy.lightMapIntensity = this.lightmaps.scale;
            return copy;
        });
        return Array.isArray(mesh.material) ? copies : copies[0];
    }
}

function placedMeshes(scene: three.Object3D): LightmappedMesh[] {
    const firstPage = firstTextureOf(scene);
    const placed: LightmappedMesh[] = [];
    scene.traverse(object => {
        const place = placeOf(object.userData as UserData, firstPage);
        if (!place) return;
        // The mesh of a node that also has a camera or a light is a child of it.
        const own = (object as Mesh).isMesh ? object : object.children.find(child => (child as Mesh).isMesh);
        if (own) placed.push({...place, mesh: own as Mesh, before: (own as Mesh).material});
    });
    return placed;
}

/** The texture of page 0 of MX_lightmap: pages follow each other, and each has rectangles. */
function firstTextureOf(scene: three.Object3D): number {
    let first = Infinity;
    scene.traverse(({userData}) => {
        const lightmap = (userData as UserData).gltfExtensions?.MX_lightmap;
        if (lightmap) first = Math.min(first, lightmap.lightMapTexture.index);
    });
    return first;
}

function placeOf({lightmap_rectangle: rectangle, gltfExtensions}: UserData, firstPage: number): Place | undefined {
    if (rectangle) {
        return {page: rectangle.page, channel: rectangle.texCoord, scale: rectangle.scale, offset: rectangle.offset};
    }
    const lightmap = gltfExtensions?.MX_lightmap;
    if (!lightmap) return undefined;
    const {lightMapTexture: {index, texCoord = 1}, scale = [1, 1], offset = [0, 0]} = lightmap;
    return {page: index - firstPage, channel: texCoord, scale, offset};
}

/** Written and read as decimals: within half a texel. */
function checkPlaces(placed: readonly LightmappedMesh[], {rectangles, pageSize}: Lightmaps): void {
    const isSame = (a: readonly number[], b: readonly number[]) => a.every((x, i) => Math.abs(x - b[i]) * pageSize < 0.5);
    for (const {mesh, page, scale, offset} of placed) {
        const known = rectangles.some(each => each.page === page && isSame(each.scale, scale) && isSame(each.offset, offset));
        if (!known) {
            throw argumentError('scene', `object "${mesh.name}": the lightmaps have no rectangle at ${offset.join(', ')} of `
                                         + `page ${page}; the scene was unwrapped for others`);
        }
    }
}
