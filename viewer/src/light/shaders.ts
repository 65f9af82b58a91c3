// SPDX-License-Identifier: Apache-2.0
// The project's own shader library in three's materials: the light of probes in place of its ambient
// light. Direct light and its shadows stay three's.
import * as three from 'three';

import begin from '../../../runtime/shaders/begin.glsl?raw';
import lppv from '../../../runtime/shaders/lppv.glsl?raw';
import sh from '../../../runtime/shaders/sh.glsl?raw';

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

/** 28 floats: the light of one place. */
export interface PlaceUniforms {
    placeSh: {value: Float32Array};
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

export type Shader = three.WebGLProgramParametersWithUniforms;

/** What a material does besides its light: `mirror.ts`. */
export interface MirrorShader {
    key: string;  // of programs that are the same
    change: (shader: Shader) => void;
}

const mirrorShaders = new WeakMap<three.Material, MirrorShader>();

type Uniforms = Record<string, three.IUniform>;
const uniformsOfMaterials = new WeakMap<three.Material, Uniforms>();

/** What all shaders of a material have: when a material returns to an earlier shader, three keeps the uniforms of
 * the one that it compiled last. So a uniform stays the same object, and only its value changes. */
export function uniformsOf(material: three.Material): Uniforms {
    const known = uniformsOfMaterials.get(material);
    if (known !== undefined) return known;
    const made: Uniforms = {};
    uniformsOfMaterials.set(material, made);
    return made;
}

/** Adds reflections to the light of a material, also to light that is set later. */
export function setMirrorShader(material: three.Material, mirror: MirrorShader | null): void {
    if (mirror === null) mirrorShaders.delete(material);
    else mirrorShaders.set(material, mirror);
    material.needsUpdate = true;
}

/** Lights a material by a change of three's shader; `key` names the change. */
function setLightShader(material: three.Material, key: string, change: (shader: Shader) => void): void {
    material.onBeforeCompile = shader => {
        Object.assign(shader.uniforms, uniformsOf(material));
        change(shader);
        mirrorShaders.get(material)?.change(shader);
    };
    material.customProgramCacheKey = () => `${key} ${mirrorShaders.get(material)?.key ?? ''}`;
}

/** The world position as `probePosition`, once. */
export function addPosition(shader: Shader): void {
    const declaration = 'varying vec3 probePosition;\n';
    if (shader.vertexShader.includes(declaration)) return;
    shader.vertexShader = declaration + shader.vertexShader.replace('#include <project_vertex>', kPlace);
    shader.fragmentShader = shader.fragmentShader.replace('#include <common>', `#include <common>\n${declaration}`);
}

function addLight(shader: Shader, declarations: string, light: string): void {
    addPosition(shader);
    shader.fragmentShader = shader.fragmentShader
        .replace('void main() {', `${declarations}void main() {`)
        .replace('#include <lights_fragment_maps>',
                 `#include <lights_fragment_maps>\n` +
                 `vec3 probeNormal = inverseTransformDirection(normal, viewMatrix);\n` +
                 `irradiance += PI * max(${light}, vec3(0.0));\n`);
}

const kLppv = shShader + lppv + 'uniform sampler3D lppv;\nuniform TetralightLppvConstants lppvConstants;\n';
const kPlaceSh = shShader + 'uniform vec4 placeSh[7];\n';

const kShOfLppv = 'tetralight_sample_lppv_7(lppv, lppvConstants, probePosition)';
const kShOfPlace = `TetralightPackedSh(${[0, 1, 2, 3, 4, 5, 6].map(i => `placeSh[${i}]`).join(', ')})`;

const lightAtVertex = (sh: string) => `
TetralightPackedSh probeSh = ${sh};
vec3 vertexNormal = inverseTransformDirection(transformedNormal, viewMatrix);
probeLight = tetralight_sample_sh9(probeSh, vertexNormal);
#ifdef DOUBLE_SIDED
    probeLightBehind = tetralight_sample_sh9(probeSh, -vertexNormal);
#endif
`;
const kVertexLight = `varying vec3 probeLight;
#ifdef DOUBLE_SIDED
    varying vec3 probeLightBehind;
#endif
`;

/** Where the light is found: at vertices it is several times as fast on meshes of small triangles. */
export type LightAt = 'pixels' | 'vertices';

/** Lights a material by a proxy volume of seven slabs. At vertices it looks the same where triangles are smaller than the
 * steps of the volume. */
export function lightByLppv(material: three.Material, uniforms: LppvUniforms, at: LightAt = 'pixels'): void {
    Object.assign(uniformsOf(material), uniforms);
    lightBySh(material, {key: 'lppv', declarations: kLppv, sh: kShOfLppv}, at);
}

/** Lights a material by the light of one place. At vertices it looks the same where normals change little. */
export function lightByPlace(material: three.Material, uniforms: PlaceUniforms, at: LightAt): void {
    Object.assign(uniformsOf(material), uniforms);
    lightBySh(material, {key: 'place', declarations: kPlaceSh, sh: kShOfPlace}, at);
}

function lightBySh(material: three.Material, {key, declarations, sh}: {key: string; declarations: string; sh: string}, at: LightAt): void {
    if (at === 'pixels') {
        setLightShader(material, key, shader => addLight(shader, declarations, `tetralight_sample_sh9(${sh}, probeNormal)`));
        return;
    }
    const sided = material.side === three.DoubleSide ? '(faceDirection > 0.0 ? probeLight : probeLightBehind)' : 'probeLight';
    setLightShader(material, `${key} at vertices`, shader => {
        addLight(shader, kVertexLight, sided);
        shader.vertexShader = shader.vertexShader
            .replace('void main() {', () => `${declarations}${kVertexLight}void main() {`)
            .replace(kPlace, () => kPlace + lightAtVertex(sh));
    });
}

/** Lights a material by its lightmap, as three does. */
export function lightByLightmap(material: three.Material): void {
    setLightShader(material, 'lightmap', () => {});
}

export const kInstanceSh = ['shaR', 'shaG', 'shaB', 'shbR', 'shbG', 'shbB', 'shC'];
export const instanceAttributes = kInstanceSh.map(name => `attribute vec4 ${name};\n`).join('');

/** Lights the instances of a material by the attributes `kInstanceSh`, per vertex. */
export function lightInstances(material: three.Material): void {
    setLightShader(material, 'instances', shader => {
        addLight(shader, 'varying vec3 probeLight;\n', 'probeLight + 0.0 * probeNormal');
        shader.vertexShader = shShader + instanceAttributes + 'varying vec3 probeLight;\n' +
            shader.vertexShader.replace(
                'probePosition = ',
                'probeLight = tetralight_sample_sh9(' +
                'TetralightPackedSh(shaR, shaG, shaB, shbR, shbG, shbB, shC), ' +
                'normalize(mat3(modelMatrix) * objectNormal));\nprobePosition = ');
    });
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
