// SPDX-License-Identifier: Apache-2.0
// Antialiased pictures on a canvas without antialiasing, so that pictures that follow each other need not wait for it.
import * as three from 'three';

import {useShadersOfCanvas} from './canvas_target';
import {ScreenPass} from './screen_pass';

const kSamples = 4;

const kFragment = `
uniform sampler2D picture;
varying vec2 place;
void main() {
    gl_FragColor = vec4(texture2D(picture, place).rgb, 1.0);
}`;

export class SmoothPicture {
    private readonly target: three.WebGLRenderTarget;
    private readonly pass: ScreenPass;

    constructor(private readonly renderer: three.WebGLRenderer) {
        this.target = new three.WebGLRenderTarget(1, 1, {samples: kSamples});
        useShadersOfCanvas(this.target, renderer);
        const {texture} = this.target;
        texture.internalFormat = 'RGBA8';  // colors are coded already
        texture.minFilter = texture.magFilter = three.NearestFilter;
        this.pass = new ScreenPass(kFragment, {picture: texture});
    }

    /** Shows on the canvas what `draw` draws. */
    draw(draw: () => void): void {
        const {renderer, target} = this;
        const size = renderer.getDrawingBufferSize(new three.Vector2());
        target.setSize(size.x, size.y);
        renderer.setRenderTarget(target);
        draw();
        renderer.setRenderTarget(null);
        this.pass.draw(renderer);
    }
}
