// SPDX-License-Identifier: Apache-2.0
// Antialiased pictures on a canvas without antialiasing, so that pictures that follow each other need not wait for it.
import * as three from 'three';

import {useShadersOfCanvas} from './canvas_target';

const kSamples = 4;

const kVertex = 'varying vec2 place;\nvoid main() {\n    place = uv;\n    gl_Position = vec4(position.xy, 0.0, 1.0);\n}';
const kFragment = `
uniform sampler2D picture;
varying vec2 place;
void main() {
    gl_FragColor = vec4(texture2D(picture, place).rgb, 1.0);
}`;

export class SmoothPicture {
    private readonly target: three.WebGLRenderTarget;
    private readonly scene = new three.Scene();
    private readonly camera = new three.Camera();

    constructor(private readonly renderer: three.WebGLRenderer) {
        this.target = new three.WebGLRenderTarget(1, 1, {samples: kSamples});
        useShadersOfCanvas(this.target, renderer);
        const {texture} = this.target;
        texture.internalFormat = 'RGBA8';  // colors are coded already
        texture.minFilter = texture.magFilter = three.NearestFilter;
        const quad = new three.Mesh(new three.PlaneGeometry(2, 2), new three.ShaderMaterial({
            vertexShader: kVertex, fragmentShader: kFragment, depthTest: false, depthWrite: false, toneMapped: false,
            uniforms: {picture: {value: texture}},
        }));
        quad.frustumCulled = false;
        this.scene.add(quad);
    }

    /** Shows on the canvas what `draw` draws. */
    draw(draw: () => void): void {
        const {renderer, target} = this;
        const size = renderer.getDrawingBufferSize(new three.Vector2());
        target.setSize(size.x, size.y);
        renderer.setRenderTarget(target);
        draw();
        renderer.setRenderTarget(null);
        renderer.render(this.scene, this.camera);
    }
}
