// SPDX-License-Identifier: Apache-2.0
// The project's own shader library in three's materials: the light of probes in place of its ambient
// light. Direct light and its shadows stay three's.
import * as three from 'three';

import begin from '../../runtime/shaders/begin.glsl?raw';
import lppv from '../../runtime/shaders/lppv.glsl?raw';
import sh from '../../runtime/shaders/sh.glsl?raw';

export const shShader = begin + sh;

/** `TetralightLppvConstants` of runtime/shaders/lppv.glsl. */
export interface LppvConstants {
    local_from_world: three.Matrix4;
    params: three.Vector4;
    low: three.Vector4;
    size_inverse: three.Vector4;
    shb_r: three.Vector4;
    shb_g: three.Vector4;
    shb_b: three.Vector4;
    shc: three.Vector4;
}

export interface LppvUniforms {
    lppv: {value: three.Data3DTexture | null};
    lppvConstants: {value: LppvConstants};
}

export function emptyConstants(): LppvConstants {
    const zero = () => new three.Vector4();
    return {local_from_world: new three.Matrix4(), params: zero(), low: zero(), size_inverse: zero(),
            shb_r: zero(), shb_g: zero(), shb_b: zero(), shc: zero()};
}

const kPlace = `
#include <project_vertex>
vec4 probePlace = vec4(transformed, 1.0);
#ifdef USE_INSTANCING
    probePlace = instanceMatrix * probePlace;
#endif
probePosition = (modelMatrix * probePlace).xyz;
`;

type Shader = three.WebGLProgramParametersWithUniforms;

function addLight(shader: Shader, declarations: string, light: string): void {
    shader.vertexShader = 'varying vec3 probePosition;\n' +
        shader.vertexShader.replace('#include <project_vertex>', kPlace);
    shader.fragmentShader = shader.fragmentShader
        .replace('#include <common>', `#include <common>\nvarying vec3 probePosition;\n${declarations}`)
        .replace('#include <lights_fragment_maps>',
                 `#include <lights_fragment_maps>\n` +
                 `vec3 probeNormal = inverseTransformDirection(normal, viewMatrix);\n` +
                 `irradiance += PI * max(${light}, vec3(0.0));\n`);
}

/** Lights a material by a proxy volume of seven slabs, per pixel. */
export function lightByLppv(material: three.Material, uniforms: LppvUniforms): void {
    material.onBeforeCompile = shader => {
        Object.assign(shader.uniforms, uniforms);
        addLight(shader, shShader + lppv +
                 'uniform sampler3D lppv;\nuniform TetralightLppvConstants lppvConstants;\n',
                 'tetralight_sample_sh9(tetralight_sample_lppv_7(lppv, lppvConstants, probePosition), ' +
                 'probeNormal)');
    };
    material.customProgramCacheKey = () => 'lppv';
}

/** Lights a material by the seven vec4 of one place. */
export function lightBySh(material: three.Material, packed: {value: three.Vector4[]}): void {
    material.onBeforeCompile = shader => {
        shader.uniforms.probeSh = packed;
        addLight(shader, shShader + 'uniform vec4 probeSh[7];\n',
                 'tetralight_sample_sh9(TetralightPackedSh(probeSh[0], probeSh[1], probeSh[2], probeSh[3], ' +
                 'probeSh[4], probeSh[5], probeSh[6]), probeNormal)');
    };
    material.customProgramCacheKey = () => 'sh';
}

export const kInstanceSh = ['shaR', 'shaG', 'shaB', 'shbR', 'shbG', 'shbB', 'shC'];
export const instanceAttributes = kInstanceSh.map(name => `attribute vec4 ${name};\n`).join('');

/** Lights the instances of a material by the attributes `kInstanceSh`, per vertex. */
export function lightInstances(material: three.Material): void {
    material.onBeforeCompile = shader => {
        addLight(shader, 'varying vec3 probeLight;\n', 'probeLight + 0.0 * probeNormal');
        shader.vertexShader = shShader + instanceAttributes + 'varying vec3 probeLight;\n' +
            shader.vertexShader.replace(
                'probePosition = ',
                'probeLight = tetralight_sample_sh9(' +
                'TetralightPackedSh(shaR, shaG, shaB, shbR, shbG, shbB, shC), ' +
                'normalize(mat3(modelMatrix) * objectNormal));\nprobePosition = ');
    };
    material.customProgramCacheKey = () => 'instances';
}

/** The 28 floats of each instance as attributes of a geometry. */
export function setInstanceSh(geometry: three.BufferGeometry,
                              packed: Float32Array): three.InstancedInterleavedBuffer {
    const buffer = new three.InstancedInterleavedBuffer(packed, 28);
    buffer.setUsage(three.DynamicDrawUsage);
    kInstanceSh.forEach((name, i) => {
        geometry.setAttribute(name, new three.InterleavedBufferAttribute(buffer, 4, 4 * i));
    });
    return buffer;
}
