// SPDX-License-Identifier: Apache-2.0
// Render targets that hold pictures as the canvas does.
import * as three from 'three';

/**
 * Lets a target hold tone-mapped colors, coded as those of the canvas are. Targets are linear and not tone-mapped,
 * unless they are of headsets: then the shaders are those of the canvas, and half as many are to compile.
 */
export function useShadersOfCanvas(target: three.WebGLRenderTarget, renderer: three.WebGLRenderer): void {
    target.texture.colorSpace = renderer.outputColorSpace;
    Object.assign(target, {isXRRenderTarget: true});
}

/** Draws on a strip of the target, or of the canvas, alone; it reaches from one part of the width to another. */
export function drawStrip(renderer: three.WebGLRenderer, from: number, to: number, draw: () => void): void {
    const target = renderer.getRenderTarget();
    const {x: width, y: height} = target === null ? renderer.getSize(new three.Vector2())
                                                  : new three.Vector2(target.width, target.height);
    const [left, right] = [from, to].map(part => Math.round(part * width));
    if (left === right) return;
    const limit = (isLimited: boolean) => {
        if (target === null) {
            renderer.setScissor(left, 0, right - left, height);
            renderer.setScissorTest(isLimited);
            return;
        }
        target.scissor.set(left, 0, right - left, height);
        target.scissorTest = isLimited;
        renderer.setRenderTarget(target);
    };
    limit(true);
    draw();
    limit(false);
}
