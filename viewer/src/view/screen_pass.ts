// SPDX-License-Identifier: Apache-2.0
// A fragment shader for each pixel of the canvas or of the render target.
import * as three from 'three';

const kVertex = `
varying vec2 place;
void main() {
    place = uv;
    gl_Position = vec4(position.xy, 0.0, 1.0);
}`;

export class ScreenPass {
    readonly uniforms: Record<string, three.IUniform>;
    private readonly scene = new three.Scene();
    private readonly camera = new three.Camera();

    /** The shader gets `place`, from 0, 0 = below left to 1, 1. What it writes is stored as it is. */
    constructor(fragmentShader: string, values: Record<string, unknown>) {
        this.uniforms = Object.fromEntries(Object.entries(values).map(([name, value]) => [name, {value}]));
        const quad = new three.Mesh(new three.PlaneGeometry(2, 2), new three.ShaderMaterial({
            vertexShader: kVertex, fragmentShader, uniforms: this.uniforms,
            depthTest: false, depthWrite: false, toneMapped: false,
        }));
        quad.frustumCulled = false;
        this.scene.add(quad);
    }

    draw(renderer: three.WebGLRenderer): void {
        renderer.render(this.scene, this.camera);
    }
}
