// SPDX-License-Identifier: Apache-2.0
// In the page: what three.js' own shader gets from the PMREM of a cube.
import * as three from 'three';

const kFaces = 6;

/** A cube of RGBA halves, faces and rows as OpenGL has them. */
async function cubeTexture(url, size) {
    const halves = new Uint16Array(await (await fetch(url)).arrayBuffer());
    const texels = 4 * size * size;
    if (halves.length !== kFaces * texels) throw new Error(`${url} has ${halves.length} numbers`);
    const faces = Array.from({length: kFaces}, (_, face) => {
        const data = halves.slice(face * texels, (face + 1) * texels);
        const image = new three.DataTexture(data, size, size, three.RGBAFormat, three.HalfFloatType);
        image.needsUpdate = true;
        return image;
    });
    const cube = new three.CubeTexture(faces, three.CubeReflectionMapping, undefined, undefined, three.LinearFilter,
                                       three.LinearFilter, three.RGBAFormat, three.HalfFloatType);
    cube.needsUpdate = true;
    return cube;
}

/** One pixel a direction. three.js mirrors x: its world sees a cube of OpenGL from outside. */
function directionTexture(directions) {
    const data = new Float32Array(directions.flatMap(([x, y, z]) => [-x, y, z, 0]));
    const texture = new three.DataTexture(data, directions.length, 1, three.RGBAFormat, three.FloatType);
    texture.needsUpdate = true;
    return texture;
}

/** The light of an environment on a surface that is seen along its normal, as standard materials take it. */
function material(pmrem, directions) {
    return new three.ShaderMaterial({
        defines: {
            USE_ENVMAP: '', ENVMAP_TYPE_PMREM: '', ENVMAP_MAX_LOD: `${pmrem.mipmaps.length - 1}.0`,
        },
        uniforms: {
            envMap: {value: pmrem}, envMapIntensity: {value: 1}, envMapRotation: {value: new three.Matrix3()},
            directions: {value: directionTexture(directions)}, roughness: {value: 0},
        },
        vertexShader: 'void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }',
        fragmentShader: `
            #include <common>
            #include <envmap_common_pars_fragment>
            #include <envmap_physical_pars_fragment>
            uniform sampler2D directions;
            uniform float roughness;
            void main() {
                vec3 normal = texelFetch(directions, ivec2(gl_FragCoord.xy), 0).xyz;
                gl_FragColor = vec4(getIBLRadiance(normal, normal, roughness), 1.0);
            }`,
    });
}

export class PmremLight {
    /** `url` of texels in halves, `size` of a face, and the directions in the cube's axes. */
    static async open({url, size, directions}) {
        return new PmremLight(await cubeTexture(url, size), directions);
    }

    constructor(cube, directions) {
        this.renderer = new three.WebGLRenderer({antialias: false});
        this.pmrem = new three.PMREMGenerator(this.renderer).fromCubemap(cube).texture;
        this.quad = new three.Mesh(new three.PlaneGeometry(2, 2), material(this.pmrem, directions));
        this.quad.frustumCulled = false;
        this.target = new three.WebGLRenderTarget(directions.length, 1, {type: three.FloatType});
    }

    /** The roughness of each level. */
    roughnesses() {
        const last = this.pmrem.mipmaps.length - 1;
        return this.pmrem.mipmaps.map((_, level) => three.PMREMGenerator.lodToRoughness(level, last));
    }

    /** Radiance around each direction: three numbers. */
    at(roughness) {
        this.quad.material.uniforms.roughness.value = roughness;
        this.renderer.setRenderTarget(this.target);
        this.renderer.render(this.quad, new three.Camera());
        const {width} = this.target;
        const pixels = new Float32Array(4 * width);
        this.renderer.readRenderTargetPixels(this.target, 0, 0, width, 1, pixels);
        return Array.from({length: width}, (_, i) => [...pixels.subarray(4 * i, 4 * i + 3)]);
    }
}
