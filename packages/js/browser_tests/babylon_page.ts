// SPDX-License-Identifier: Apache-2.0
// What the tests run in the browser, as `window.engine`: squares of Babylon, of which the camera sees the middle.
import {Camera} from '@babylonjs/core/Cameras/camera.js';
import {FreeCamera} from '@babylonjs/core/Cameras/freeCamera.js';
import {Engine} from '@babylonjs/core/Engines/engine.js';
import type {Material} from '@babylonjs/core/Materials/material.js';
import {MultiMaterial} from '@babylonjs/core/Materials/multiMaterial.js';
import {PBRMaterial} from '@babylonjs/core/Materials/PBR/pbrMaterial.js';
import {StandardMaterial} from '@babylonjs/core/Materials/standardMaterial.js';
import {RawCubeTexture} from '@babylonjs/core/Materials/Textures/rawCubeTexture.js';
import {Color3, Color4} from '@babylonjs/core/Maths/math.color.js';
import {Quaternion, Vector3} from '@babylonjs/core/Maths/math.vector.js';
import '@babylonjs/core/Materials/Textures/baseTexture.polynomial.js';
import {CreatePlane} from '@babylonjs/core/Meshes/Builders/planeBuilder.js';
import type {Mesh} from '@babylonjs/core/Meshes/mesh.js';
import {TransformNode} from '@babylonjs/core/Meshes/transformNode.js';
import {Scene} from '@babylonjs/core/scene.js';

import {ProbeVolume, sphericalPolynomial} from '../src/babylon/index.js';
import {read, Volume} from '../src/index.js';
import {bytesOf, readPixel} from './read_pixel.js';
import type {EnginePage, Square} from './squares.js';

const engine = new Engine(document.querySelector('canvas')!, false, {preserveDrawingBuffer: true});
const gl = engine._gl as WebGL2RenderingContext;

let volume: Volume;

/** A scene whose pictures are linear, and its camera. A left-handed one has the volume mirrored in x, as glTF scenes. */
class World {
    readonly scene = new Scene(engine);
    private readonly camera: FreeCamera;

    constructor(rightHanded: boolean) {
        const {scene} = this;
        scene.useRightHandedSystem = rightHanded;
        scene.clearColor = new Color4(0, 0, 0, 1);
        scene.imageProcessingConfiguration.applyByPostProcess = true;
        this.camera = new FreeCamera('camera', Vector3.Zero(), scene);
        this.camera.mode = Camera.ORTHOGRAPHIC_CAMERA;
        this.camera.minZ = 0.01;
        this.camera.maxZ = 2;
        [this.camera.orthoLeft, this.camera.orthoRight] = [-0.01, 0.01];
        [this.camera.orthoBottom, this.camera.orthoTop] = [-0.01, 0.01];
    }

    vector([x, y, z]: readonly number[]): Vector3 {
        return new Vector3(this.scene.useRightHandedSystem ? x : -x, y, z);
    }

    makeSquare(square: Square, material: Material): Mesh {
        const mesh = CreatePlane('square', {size: 1}, this.scene);
        mesh.material = material;
        this.place(mesh, square);
        return mesh;
    }

    place(mesh: Mesh, {position, normal}: Square): void {
        mesh.position = this.vector(position);
        const front = Vector3.FromArray(mesh.getVerticesData('normal')!);
        mesh.rotationQuaternion = Quaternion.FromUnitVectorsToRef(front, this.vector(normal), new Quaternion());
        mesh.computeWorldMatrix(true);
    }

    colorOf({position, normal}: Square): number[] {
        const at = this.vector(position);
        this.camera.position = at.add(this.vector(normal));
        this.camera.upVector = this.vector([normal[2], normal[0], normal[1]]);
        this.camera.setTarget(at);
        this.scene.render();
        return readPixel(gl);
    }
}

/** Without a specular part, which takes 4 % of the diffuse light. */
function makePbr(scene: Scene): PBRMaterial {
    const material = new PBRMaterial('white', scene);
    material.metallic = 0;
    material.roughness = 1;
    material.metallicF0Factor = 0;
    return material;
}

/** Its pictures are not linear: what it computes is what is shown. */
function makeStandard(scene: Scene): StandardMaterial {
    scene.imageProcessingConfiguration.applyByPostProcess = false;
    const material = new StandardMaterial('white', scene);
    material.specularColor = new Color3(0, 0, 0);
    return material;
}

/** All squares below one node; they share one material. */
async function shadeObjects(squares: readonly Square[], rightHanded: boolean,
                            makeMaterial: (scene: Scene) => Material, prepare = (probes: ProbeVolume) => probes.update()) {
    const world = new World(rightHanded);
    const root = new TransformNode('root', world.scene);
    const material = makeMaterial(world.scene);
    const meshes = squares.map(square => {
        const mesh = world.makeSquare(square, material);
        mesh.parent = root;
        return mesh;
    });
    const probes = new ProbeVolume(volume);
    probes.add(root);
    prepare(probes);
    await world.scene.whenReadyAsync();
    const colors = squares.map((square, i) => {
        meshes.forEach((mesh, k) => mesh.setEnabled(i === k));
        return world.colorOf(square);
    });
    probes.remove(root);
    if (meshes.some(mesh => mesh.material !== material)) throw new Error('the material is not that of before');
    world.scene.dispose();
    return colors;
}

/** The same, after the light of the volume was out. */
function shadeRefreshed(squares: readonly Square[]): Promise<number[][]> {
    const weights = Object.fromEntries(volume.layers.map(({name, weight}) => [name, weight]));
    return shadeObjects(squares, false, makePbr, probes => {
        volume.setWeights(Object.fromEntries(volume.layers.map(({name}) => [name, 0])));
        probes.update();
        volume.setWeights(weights);
        probes.refresh();
    });
}

function makeMulti(scene: Scene): MultiMaterial {
    const material = new MultiMaterial('several', scene);
    material.subMaterials = [makePbr(scene)];
    return material;
}

/** A black environment with the light of the position, which is changed for each square. */
async function shadeEnvironment(squares: readonly Square[], rightHanded: boolean): Promise<number[][]> {
    const world = new World(rightHanded);
    const black = Array.from({length: 6}, () => new Uint8Array([0, 0, 0, 255]));
    const environment = new RawCubeTexture(world.scene, black, 1);
    world.scene.environmentTexture = environment;
    const material = makePbr(world.scene);
    // Without it the diffuse light is less by what the surface reflects.
    material.brdf.useLegacySpecularEnergyConservation = true;
    const mesh = world.makeSquare(squares[0], material);
    environment.sphericalPolynomial = sphericalPolynomial(volume.light(squares[0].position).sh, world.scene);
    await world.scene.whenReadyAsync();
    const colors = squares.map(square => {
        environment.sphericalPolynomial = sphericalPolynomial(volume.light(square.position).sh, world.scene);
        world.scene.markAllMaterialsAsDirty(1);
        world.place(mesh, square);
        return world.colorOf(square);
    });
    world.scene.dispose();
    return colors;
}

const ways: Record<string, (squares: readonly Square[]) => Promise<number[][]>> = {
    'PBR, left-handed': squares => shadeObjects(squares, false, makePbr),
    'PBR, right-handed': squares => shadeObjects(squares, true, makePbr),
    'standard material': squares => shadeObjects(squares, false, makeStandard),
    'several materials': squares => shadeObjects(squares, true, makeMulti),
    refreshed: shadeRefreshed,
    'environment, left-handed': squares => shadeEnvironment(squares, false),
    'environment, right-handed': squares => shadeEnvironment(squares, true),
};

const page: EnginePage = {
    open(base64, weights) {
        volume = read(bytesOf(base64));
        volume.setWeights(weights);
    },
    shade: (squares, way) => ways[way](squares),
};
Object.assign(window, {engine: page});
