// SPDX-License-Identifier: Apache-2.0
// The page has run filament.js, which makes the global `Filament`.
import type * as FilamentModule from 'filament';

import {SceneLight} from '../src/filament/index.js';
import type {BallView, MakeBallView} from './ball_view.js';
import {makeGlb, makeSphere} from './glb.js';
import {eyeOf, kFieldOfView, kRadius, Position} from './road.js';

declare let Filament: typeof FilamentModule;

export const makeFilamentBall: MakeBallView = async (canvas, volume, exposure): Promise<BallView> => {
    await new Promise<void>(resolve => Filament.init([], resolve));
    const engine = Filament.Engine.create(canvas, {antialias: true, preserveDrawingBuffer: true});
    const scene = engine.createScene();
    const swapChain = engine.createSwapChain();
    const renderer = engine.createRenderer();
    renderer.setClearOptions({clearColor: [0, 0, 0, 1], clear: true});
    const camera = engine.createCamera(Filament.EntityManager.get().create());
    // Its factor is shutter time × sensitivity / 120 at aperture 1. setExposureDirect(x) has the factor 1 / x.
    camera.setExposure(1, 1, 120 * exposure);
    camera.setProjectionFov(kFieldOfView, 1, 0.1, 10, Filament.Camera$Fov.VERTICAL);
    const view = makeView(engine, canvas);
    view.setCamera(camera);
    view.setScene(scene);
    const ball = addBall(engine, scene);
    const light = new SceneLight(Filament, engine, scene, volume);
    return {
        name: 'Filament 1.53',
        async draw(position) {
            placeBall(engine, ball, position);
            camera.lookAt([...eyeOf(position)], [...position], [0, 1, 0]);
            light.moveTo(position);
            // Filament leaves out frames that come too early.
            while (!renderer.beginFrame(swapChain)) {
                engine.execute();
                await new Promise(resolve => requestAnimationFrame(resolve));
            }
            renderer.renderView(view);
            renderer.endFrame();
            engine.execute();
        },
    };
};

function makeView(engine: FilamentModule.Engine, canvas: HTMLCanvasElement): FilamentModule.View {
    const view = engine.createView();
    view.setViewport([0, 0, canvas.width, canvas.height]);
    const linear = Filament.ColorGrading.Builder().toneMapping(Filament.ColorGrading$ToneMapping.LINEAR).build(engine);
    view.setColorGrading(linear);
    return view;
}

function addBall(engine: FilamentModule.Engine, scene: FilamentModule.Scene): FilamentModule.Entity {
    const asset = engine.createAssetLoader().createAsset(makeGlb(makeSphere()));
    asset.loadResources(() => {}, () => {}, null, null);
    scene.addEntity(asset.getRenderableEntities()[0]);
    return asset.getRoot();
}

function placeBall(engine: FilamentModule.Engine, ball: FilamentModule.Entity, [x, y, z]: Position): void {
    const transforms = engine.getTransformManager();
    const instance = transforms.getInstance(ball);
    transforms.setTransform(instance, [kRadius, 0, 0, 0, 0, kRadius, 0, 0, 0, 0, kRadius, 0, x, y, z, 1]);
    instance.delete();
}
