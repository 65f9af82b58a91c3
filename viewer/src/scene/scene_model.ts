// SPDX-License-Identifier: Apache-2.0
// A glTF scene, lit by its own lights and by a field of light from the probes.
import * as three from 'three';
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';

import {gridOf} from '../light/light_field';
import {placesOf, SceneLightmaps} from '../light/lightmaps';
import type {ShinySurface} from '../light/mirror';
import {lightByLppv, LppvUniforms} from '../light/shaders';
import {aimShadows} from '../light/shadows';
import {isDense} from './dense_mesh';
import {firstView, View} from './first_view';
import type {Gltf} from './glb';
import {ObjectLight} from './object_light';
import {objectsOf, SceneObject} from './scene_objects';

export interface SceneModel {
    /** Of the file. */
    json: Gltf;
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
    objects: SceneObject[];
    /** Of the objects that move: they have no light of their own until it is placed. */
    movers: ObjectLight[];
}

export async function loadScene(bytes: ArrayBuffer, field: LppvUniforms): Promise<SceneModel> {
    const gltf = await new GLTFLoader().parseAsync(bytes, '');
    const root = gltf.scene;
    const points: three.Object3D[] = [];
    root.traverse(node => {
        if (node instanceof three.Points || node instanceof three.Line) points.push(node);
    });
    for (const node of points) node.removeFromParent();  // groups of probes have balls of their own
    root.updateMatrixWorld(true);
    const box = new three.Box3().setFromObject(root);
    const lighting: Lighting = {field, step: stepOf(box), atVertices: new WeakSet()};
    const lights: three.Light[] = [];
    const emitters: three.MeshLambertMaterial[] = [];
    const surfaces: ShinySurface[] = [];
    root.traverse(node => {
        if (node instanceof three.Mesh) emitters.push(...prepareMesh(node, lighting, surfaces));
        if (node instanceof three.Light && prepareLight(node)) lights.push(node);
    });
    aimShadows(root, box);
    const sky = (root.userData.sky as {radiance?: number[]} | undefined)?.radiance ?? null;
    const places = placesOf(gltf).filter(({mesh}) => mesh.material instanceof three.MeshLambertMaterial);
    const lightmaps = new SceneLightmaps(places, material => lightSurface(material, lighting));
    const objects = objectsOf(gltf);
    const movers = objects.filter(({isStatic}) => !isStatic).map(object => new ObjectLight(object));
    return {json: gltf.parser.json as Gltf, root, box, sky, lights, emitters, lightmaps, surfaces, objects, movers,
            view: firstView(gltf.cameras[0], box)};
}

/** How the field lights surfaces. */
interface Lighting {
    field: LppvUniforms;
    step: number;  // of the field's grid, metres
    atVertices: WeakSet<three.Material>;
}

function stepOf(box: three.Box3): number {
    const {size, resolution} = gridOf(box);
    return Math.min(...size.toArray().map((length, axis) => length / (resolution[axis] - 1)));
}

function lightSurface(material: three.Material, {field, atVertices}: Lighting): void {
    lightByLppv(material, field, atVertices.has(material) ? 'vertices' : 'pixels');
}

/** Returns its materials whose emission a bake sees, and adds what mirrors to `surfaces`. */
function prepareMesh(mesh: three.Mesh, lighting: Lighting, surfaces: ShinySurface[]): three.MeshLambertMaterial[] {
    mesh.castShadow = true;
    mesh.receiveShadow = true;
    const isFine = !(mesh instanceof three.InstancedMesh || mesh instanceof three.SkinnedMesh) &&
        isDense(mesh.geometry, mesh.matrixWorld, lighting.step);
    const made = (Array.isArray(mesh.material) ? mesh.material : [mesh.material]).map(material => {
        const lambert = material instanceof three.MeshStandardMaterial ? lambertOf(material) : material;
        lambert.shadowSide = three.DoubleSide;  // three's default, back faces, lets light under what stands
        if (isFine) lighting.atVertices.add(lambert);
        lightSurface(lambert, lighting);
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
