// SPDX-License-Identifier: Apache-2.0
// A glTF scene, lit by its own lights and by a field of light from the probes.
import * as three from 'three';
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';

import {firstView, View} from './first_view';
import {placesOf, SceneLightmaps} from './lightmaps';
import type {ShinySurface} from './mirror';
import {lightByLppv, LppvUniforms} from './shaders';

const kShadowTexels = 2048;

export interface SceneModel {
    root: three.Group;
    box: three.Box3;
    /** Of the file's first camera, or nothing. */
    view: View | null;
    /** Radiance of a constant sky that the file says, or nothing. */
    sky: number[] | null;
    /** Of the file, those that are not baked as a whole. */
    lights: three.Light[];
    /** Materials whose emission a bake sees. */
    emitters: three.MeshLambertMaterial[];
    /** Of the meshes that the file gives a place in pages. */
    lightmaps: SceneLightmaps;
    /** Those that mirror reflection probes. */
    surfaces: ShinySurface[];
}

export async function loadScene(bytes: ArrayBuffer, field: LppvUniforms): Promise<SceneModel> {
    const gltf = await new GLTFLoader().parseAsync(bytes, '');
    const root = gltf.scene;
    const points: three.Object3D[] = [];
    const lights: three.Light[] = [];
    const emitters: three.MeshLambertMaterial[] = [];
    const surfaces: ShinySurface[] = [];
    root.traverse(node => {
        if (node instanceof three.Points || node instanceof three.Line) points.push(node);
        if (node instanceof three.Mesh) emitters.push(...prepareMesh(node, field, surfaces));
        if (node instanceof three.Light && prepareLight(node)) lights.push(node);
    });
    for (const node of points) node.removeFromParent();  // groups of probes have balls of their own
    root.updateMatrixWorld(true);
    const box = new three.Box3().setFromObject(root);
    aimShadows(root, box);
    const sky = (root.userData.sky as {radiance?: number[]} | undefined)?.radiance ?? null;
    const places = placesOf(gltf).filter(({mesh}) => mesh.material instanceof three.MeshLambertMaterial);
    const lightmaps = new SceneLightmaps(places, material => lightByLppv(material, field));
    return {root, box, sky, lights, emitters, lightmaps, surfaces, view: firstView(gltf.cameras[0], box)};
}

/** Returns its materials whose emission a bake sees, and adds what mirrors to `surfaces`. */
function prepareMesh(mesh: three.Mesh, field: LppvUniforms, surfaces: ShinySurface[]): three.MeshLambertMaterial[] {
    mesh.castShadow = true;
    mesh.receiveShadow = true;
    const made = (Array.isArray(mesh.material) ? mesh.material : [mesh.material]).map(material => {
        const lambert = material instanceof three.MeshStandardMaterial ? lambertOf(material) : material;
        lambert.shadowSide = three.DoubleSide;  // three's default, back faces, lets light under what stands
        lightByLppv(lambert, field);
        if (material instanceof three.MeshStandardMaterial) surfaces.push(shinySurface(mesh, material, lambert));
        return lambert;
    });
    mesh.material = made.length === 1 ? made[0] : made;
    return made.filter((material): material is three.MeshLambertMaterial =>
        material instanceof three.MeshLambertMaterial && bakesEmission(material.userData.bake_emission));
}

const bakesEmission = (word: unknown) => word !== 'none' && word !== false;

/** A bake takes surfaces for Lambert's. */
function lambertOf(material: three.MeshStandardMaterial): three.MeshLambertMaterial {
    const {color, map, emissive, emissiveMap, emissiveIntensity, alphaMap, alphaTest, transparent, opacity,
           side, vertexColors, depthWrite, name, userData} = material;
    return new three.MeshLambertMaterial({
        color, map, emissive, emissiveMap, emissiveIntensity, alphaMap, alphaTest, transparent, opacity,
        side, vertexColors, depthWrite, name, userData,
    });
}

function shinySurface(mesh: three.Mesh, material: three.MeshStandardMaterial, lambert: three.Material): ShinySurface {
    const {metalness, roughness, metalnessMap: map} = material;
    return {material: lambert, shine: {metalness, roughness, map}, box: () => new three.Box3().setFromObject(mesh)};
}

/** What probes hold of a light already is not shone again. False: they hold all of it. */
function prepareLight(light: three.Light): boolean {
    const words = {...light.userData, ...light.parent?.userData} as {mode?: string};
    light.visible = words.mode !== 'baked';
    light.castShadow = light instanceof three.DirectionalLight;
    return light.visible;
}

/** Shadow maps of suns hold the whole box. */
export function aimShadows(root: three.Object3D, box: three.Box3): void {
    const sphere = box.getBoundingSphere(new three.Sphere());
    root.traverse(node => {
        if (!(node instanceof three.DirectionalLight)) return;
        const from = node.getWorldPosition(new three.Vector3());
        const direction = node.target.getWorldPosition(new three.Vector3()).sub(from).normalize();
        const place = sphere.center.clone().addScaledVector(direction, -2 * sphere.radius);
        node.position.copy(node.parent!.worldToLocal(place));
        const {shadow} = node;
        const texel = 2 * sphere.radius / kShadowTexels;
        shadow.mapSize.set(kShadowTexels, kShadowTexels);
        shadow.normalBias = texel;
        shadow.bias = -texel / (4 * sphere.radius);
        shadow.radius = 0;  // three's wider filter is noisy
        const {camera} = shadow;
        camera.left = camera.bottom = -sphere.radius;
        camera.right = camera.top = sphere.radius;
        camera.near = 0.5 * sphere.radius;
        camera.far = 4 * sphere.radius;
        camera.updateProjectionMatrix();
    });
}

export function disposeScene(root: three.Object3D): void {
    root.traverse(node => {
        if (!(node instanceof three.Mesh)) return;
        node.geometry.dispose();
        const materials = Array.isArray(node.material) ? node.material : [node.material];
        for (const material of materials as three.MeshStandardMaterial[]) {
            material.map?.dispose();
            material.metalnessMap?.dispose();
            material.dispose();
        }
    });
}
