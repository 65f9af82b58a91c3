// SPDX-License-Identifier: Apache-2.0
// What the tests run in the browser, as `window.engine`: a square of Filament, of which the camera sees the middle. The
// page has run filament.js, which makes the global `Filament`.
import type * as FilamentModule from 'filament';

import {makeGlb} from '../gallery/glb.js';
import {irradianceSh, SceneLight} from '../src/filament/index.js';
import {read, Volume} from '../src/index.js';
import {bytesOf, readPixel} from './read_pixel.js';
import type {EnginePage, Square} from './squares.js';

declare let Filament: typeof FilamentModule;

let volume: Volume;

/** A square around the origin whose front is z. */
const kSquare = {
    positions: new Float32Array([-0.5, -0.5, 0, 0.5, -0.5, 0, 0.5, 0.5, 0, -0.5, 0.5, 0]),
    normals: new Float32Array([0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1]),
    indices: new Uint16Array([0, 1, 2, 0, 2, 3]),
};

const cross = ([ax, ay, az]: readonly number[], [bx, by, bz]: readonly number[]) =>
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];

function unit(v: readonly number[]): number[] {
    const length = Math.hypot(...v);
    return v.map(x => x / length);
}

/** To a square from that around the origin, by columns. */
function placeOf({position, normal}: Square): number[] {
    const x = unit(cross([normal[2], normal[0], normal[1]], normal));
    const y = cross(normal, x);
    return [...x, 0, ...y, 0, ...normal, 0, ...position, 1];
}

class World {
    readonly engine: FilamentModule.Engine;
    readonly scene: FilamentModule.Scene;
    private readonly canvas = document.querySelector('canvas')!;
    private readonly swapChain: FilamentModule.SwapChain;
    private readonly renderer: FilamentModule.Renderer;
    private readonly view: FilamentModule.View;
    private readonly camera: FilamentModule.Camera;
    private readonly square: FilamentModule.Entity;

    constructor() {
        this.engine = Filament.Engine.create(this.canvas, {preserveDrawingBuffer: true, antialias: false});
        const {engine} = this;
        this.scene = engine.createScene();
        this.swapChain = engine.createSwapChain();
        this.renderer = engine.createRenderer();
        this.camera = engine.createCamera(Filament.EntityManager.get().create());
        this.camera.setExposureDirect(1);
        this.camera.setProjection(Filament.Camera$Projection.ORTHO, -0.01, 0.01, -0.01, 0.01, 0.01, 2);
        this.view = engine.createView();
        this.view.setCamera(this.camera);
        this.view.setScene(this.scene);
        this.view.setViewport([0, 0, this.canvas.width, this.canvas.height]);
        // Without it pictures are linear.
        this.view.setPostProcessingEnabled(false);
        const asset = engine.createAssetLoader().createAsset(makeGlb(kSquare));
        asset.loadResources(() => {}, () => {}, null, null);
        this.square = asset.getRoot();
        this.scene.addEntity(asset.getRenderableEntities()[0]);
    }

    place(square: Square): void {
        const transforms = this.engine.getTransformManager();
        const instance = transforms.getInstance(this.square);
        transforms.setTransform(instance, placeOf(square));
        instance.delete();
        const {position, normal} = square;
        this.camera.lookAt(position.map((x, axis) => x + normal[axis]), position, [normal[2], normal[0], normal[1]]);
    }

    async draw(): Promise<number[]> {
        // Filament leaves out frames that come too early.
        while (!this.renderer.beginFrame(this.swapChain)) {
            this.engine.execute();
            await nextFrame();
        }
        this.renderer.renderView(this.view);
        this.renderer.endFrame();
        this.engine.execute();
        return readPixel(this.canvas.getContext('webgl2')!);
    }

    /** Until the shader is there. */
    async begin(): Promise<void> {
        for (let frame = 0; frame < 100 && Math.max(...await this.draw()) === 0; ++frame) await nextFrame();
    }
}

const nextFrame = () => new Promise(resolve => requestAnimationFrame(resolve));

let world: World | undefined;

function draw(square: Square): Promise<number[]> {
    world!.place(square);
    return world!.draw();
}

/** The light follows the square. */
async function shadeMoving(square: Square, light: SceneLight): Promise<number[]> {
    light.moveTo(square.position);
    return draw(square);
}

/** The same, after the light of the volume was out. */
async function shadeRefreshed(square: Square, light: SceneLight): Promise<number[]> {
    const weights = Object.fromEntries(volume.layers.map(({name, weight}) => [name, weight]));
    const dark = Object.fromEntries(volume.layers.map(({name}) => [name, 0]));
    volume.setWeights(dark);
    light.moveTo(square.position);
    light.refresh();
    volume.setWeights(weights);
    light.refresh();
    return draw(square);
}

/** Without a SceneLight: coefficients alone, with half of them and twice the intensity. */
async function shadeByCoefficients(square: Square): Promise<number[]> {
    const half = irradianceSh(volume.light(square.position).sh).map(value => value / 2);
    const built = Filament.IndirectLight.Builder().irradianceSh(3, half).intensity(2).build(world!.engine);
    world!.scene.setIndirectLight(built);
    const color = await draw(square);
    world!.scene.setIndirectLight(null);
    world!.engine.destroyIndirectLight(built);
    return color;
}

const ways: Record<string, (square: Square, light: SceneLight) => Promise<number[]>> =
    {moving: shadeMoving, refreshed: shadeRefreshed, coefficients: shadeByCoefficients};

const engine: EnginePage = {
    open(base64, weights) {
        volume = read(bytesOf(base64));
        volume.setWeights(weights);
    },
    async shade(squares, way) {
        if (!world) await new Promise<void>(resolve => Filament.init([], resolve));
        world ??= new World();
        const light = new SceneLight(Filament, world.engine, world.scene, volume);
        light.moveTo(squares[0].position);
        world.place(squares[0]);
        await world.begin();
        const colors: number[][] = [];
        for (const square of squares) colors.push(await ways[way](square, light));
        light.destroy();
        return colors;
    },
};
Object.assign(window, {engine});
