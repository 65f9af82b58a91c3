// SPDX-License-Identifier: Apache-2.0
// The light of the view, read without waiting for the renderer.
import * as three from 'three';

import {luminance} from '../light/radiometry';
import {useShadersOfCanvas} from './canvas_target';
import {takeToneMappingBack} from './exposure';

const kWidth = 64;
const kHeight = 36;

/** Exposures under which light is found again, for usual, bright and dark views. */
const kUsual = 2 ** -12;
const kForBright = 2 ** -30;
const kForDark = 2 ** 6;
/** Above it, tone mapping compresses; below it, its toe loses the light. Of what is exposed. */
const kMost = 0.7;
const kLeast = 2 ** -20;

/** RGBA of the view that `draw` draws, without marks. */
export async function measureLight(renderer: three.WebGLRenderer, scene: three.Scene, draw: () => void): Promise<Float32Array> {
    const pixels = await measureAt(kUsual, renderer, scene, draw);
    const bright = kUsual * brightOf(pixels);
    if (bright > kMost) return measureAt(kForBright, renderer, scene, draw);
    if (bright < kLeast) return measureAt(kForDark, renderer, scene, draw);
    return pixels;
}

/** The luminance that one of fifty pixels exceeds. */
function brightOf(pixels: Float32Array): number {
    const all = Float32Array.from({length: pixels.length / 4}, (_, i) => luminance(pixels, 4 * i)).sort();
    return all[Math.floor(0.98 * all.length)];
}

async function measureAt(exposure: number, renderer: three.WebGLRenderer, scene: three.Scene, draw: () => void): Promise<Float32Array> {
    const target = new three.WebGLRenderTarget(kWidth, kHeight, {type: three.FloatType});
    useShadersOfCanvas(target, renderer);
    const {toneMapping, toneMappingExposure} = renderer;
    const showMarks = hideMarks(scene);
    renderer.toneMapping = three.NeutralToneMapping;  // the one that can be taken back
    renderer.toneMappingExposure = exposure;
    renderer.setRenderTarget(target);
    draw();
    renderer.setRenderTarget(null);
    renderer.toneMapping = toneMapping;
    renderer.toneMappingExposure = toneMappingExposure;
    showMarks();
    const pixels = new Float32Array(4 * kWidth * kHeight);
    await renderer.readRenderTargetPixelsAsync(target, 0, 0, kWidth, kHeight, pixels);
    target.dispose();
    takeToneMappingBack(pixels, exposure);
    return pixels;
}

/** Hides what has colours of its own whatever the exposure; returns what undoes it. */
export function hideMarks(scene: three.Scene): () => void {
    const marks: three.Object3D[] = [];
    scene.traverseVisible(object => {
        const {material} = object as Partial<three.Mesh>;
        const isMark = object.userData.isMark || [material ?? []].flat().some(({toneMapped}) => !toneMapped);
        if (isMark) marks.push(object);
    });
    for (const mark of marks) mark.visible = false;
    return () => { for (const mark of marks) mark.visible = true; };
}
