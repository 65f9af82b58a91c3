// SPDX-License-Identifier: Apache-2.0
// What the tests run in the browser, as `window.engine`: squares of PlayCanvas, of which the camera sees the middle.
import * as pc from 'playcanvas';

import {read} from '../src/index.js';
import {ambientSh, ProbeVolume} from '../src/playcanvas/index.js';
import {bytesOf, readPixel} from './read_pixel.js';
import type {EnginePage, Square} from './squares.js';

const app = new pc.Application(document.querySelector('canvas')!, {
    graphicsDeviceOptions: {antialias: false, preserveDrawingBuffer: true},
});
app.autoRender = false;
app.start();
const {gl} = app.graphicsDevice as pc.WebglGraphicsDevice;

const camera = new pc.Entity('camera');
camera.addComponent('camera', {projection: pc.PROJECTION_ORTHOGRAPHIC, orthoHeight: 0.01, nearClip: 0.01, farClip: 2,
                               gammaCorrection: pc.GAMMA_NONE, toneMapping: pc.TONEMAP_NONE});
app.root.addChild(camera);

const plane = pc.Mesh.fromGeometry(app.graphicsDevice, new pc.PlaneGeometry());
plane.incRefCount();  // stays when its last entity is destroyed

function makeWhite(): pc.StandardMaterial {
    const material = new pc.StandardMaterial();
    material.diffuse = new pc.Color(1, 1, 1);
    material.update();
    return material;
}

const vector = (v: readonly number[]) => new pc.Vec3(v as number[]);

/** A plane, whose normal is its y. */
function makeSquare({position, normal}: Square, material: pc.Material): pc.Entity {
    const entity = new pc.Entity();
    entity.addComponent('render', {meshInstances: [new pc.MeshInstance(plane, material)]});
    entity.setPosition(vector(position));
    entity.setRotation(new pc.Quat().setFromDirections(pc.Vec3.UP, vector(normal)));
    app.root.addChild(entity);
    return entity;
}

function colorOf({position, normal}: Square): number[] {
    camera.setPosition(vector(position).add(vector(normal)));
    camera.lookAt(vector(position), new pc.Vec3(normal[2], normal[0], normal[1]));
    app.render();
    return readPixel(gl);
}

function colorsOf(squares: readonly Square[], entities: readonly pc.Entity[]): number[][] {
    return squares.map((square, i) => {
        entities.forEach((entity, k) => { entity.enabled = i === k; });
        return colorOf(square);
    });
}

let probes: ProbeVolume;

/** All squares below one entity; they share one material. */
function shadeObjects(squares: readonly Square[], prepare = () => probes.update()): number[][] {
    const material = makeWhite();
    const root = new pc.Entity();
    app.root.addChild(root);
    const entities = squares.map(square => makeSquare(square, material));
    entities.forEach(entity => root.addChild(entity));
    probes.add(root);
    prepare();
    const colors = colorsOf(squares, entities);
    probes.remove(root);
    if (entities.some(entity => entity.render!.meshInstances[0].material !== material)) {
        throw new Error('the material is not that of before');
    }
    root.destroy();
    return colors;
}

/** The same, after the light of the volume was out. */
function shadeRefreshed(squares: readonly Square[]): number[][] {
    const {volume} = probes;
    const weights = Object.fromEntries(volume.layers.map(({name, weight}) => [name, weight]));
    return shadeObjects(squares, () => {
        volume.setWeights(Object.fromEntries(volume.layers.map(({name}) => [name, 0])));
        probes.update();
        volume.setWeights(weights);
        probes.refresh();
    });
}

/** One entity that moves, with a black sky that turns and has half of its intensity. */
function shadeBelowSky(squares: readonly Square[]): number[][] {
    const side = new Uint8Array([0, 0, 0, 255]);
    app.scene.skybox = new pc.Texture(app.graphicsDevice, {
        cubemap: true, width: 1, height: 1, format: pc.PIXELFORMAT_RGBA8, mipmaps: false,
        levels: [Array<Uint8Array>(6).fill(side)] as unknown as Uint8Array[],
    });
    app.scene.skyboxIntensity = 0.5;
    const entity = makeSquare(squares[0], makeWhite());
    probes.add(entity);
    const colors = squares.map((square, i) => {
        app.scene.skyboxRotation = new pc.Quat().setFromEulerAngles(20 * i, 33 * i, 0);
        entity.setPosition(vector(square.position));
        entity.setRotation(new pc.Quat().setFromDirections(pc.Vec3.UP, vector(square.normal)));
        probes.update();
        return colorOf(square);
    });
    probes.remove(entity);
    entity.destroy();
    app.scene.skybox = null;
    app.scene.skyboxIntensity = 1;
    return colors;
}

/** Without a ProbeVolume: the material has the light. */
function shadeMaterials(squares: readonly Square[]): number[][] {
    return squares.map(square => {
        const material = makeWhite();
        Object.assign(material, {ambientSH: ambientSh(probes.volume.light(square.position).sh)});
        material.update();
        const entity = makeSquare(square, material);
        const color = colorOf(square);
        entity.destroy();
        return color;
    });
}

const ways: Record<string, (squares: readonly Square[]) => number[][]> =
    {objects: shadeObjects, refreshed: shadeRefreshed, sky: shadeBelowSky, materials: shadeMaterials};

const engine: EnginePage = {
    open(base64, weights) {
        const volume = read(bytesOf(base64));
        volume.setWeights(weights);
        probes = new ProbeVolume(volume, app.scene);
    },
    shade: (squares, way) => Promise.resolve(ways[way](squares)),
};
Object.assign(window, {engine});
