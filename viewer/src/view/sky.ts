// SPDX-License-Identifier: Apache-2.0
// A constant sky behind everything. Unlike `Scene.background` it is exposed with the scene.
import * as three from 'three';

export class Sky {
    readonly mesh: three.Mesh<three.PlaneGeometry, three.ShaderMaterial>;
    readonly radiance = new three.Color();

    constructor() {
        this.mesh = new three.Mesh(new three.PlaneGeometry(2, 2), new three.ShaderMaterial({
            vertexShader: 'void main() { gl_Position = vec4(position.xy, 1.0, 1.0); }',
            fragmentShader: 'uniform vec3 radiance;\nvoid main() {\n    gl_FragColor = vec4(radiance, 1.0);\n' +
                '    #include <tonemapping_fragment>\n    #include <colorspace_fragment>\n}',
            uniforms: {radiance: {value: this.radiance}},
            depthTest: false, depthWrite: false,
        }));
        this.mesh.frustumCulled = false;
        this.mesh.renderOrder = -1;
    }
}
