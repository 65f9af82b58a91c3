// SPDX-License-Identifier: Apache-2.0
// Adds the light of probes to the materials of three.js: to the irradiance that their shaders sum.
import type * as three from 'three';

/** Materials whose shaders sum irradiance: standard, physical, Lambert, Phong and toon. */
export function isLit(material: three.Material): boolean {
    return ['MeshStandardMaterial', 'MeshPhysicalMaterial', 'MeshLambertMaterial', 'MeshPhongMaterial', 'MeshToonMaterial']
        .includes(material.type);
}

/** Where the seven vec4 of `packSh` come from: a uniform of the material, or a texture with those of all instances. */
export type LightSource = {sh: Float32Array} | {texture: three.DataTexture};

/** Irradiance on a world normal. `sh` names one of the seven vectors. */
export const irradianceFunction = (sh: (i: number) => string) => `
vec3 tetralightIrradiance(vec3 n) {
    vec4 linear = vec4(n, 1.0);
    vec4 quadratic = vec4(n.x * n.y, n.y * n.z, n.z * n.z, n.z * n.x);
    vec3 sum = vec3(dot(${sh(0)}, linear) + dot(${sh(3)}, quadratic), dot(${sh(1)}, linear) + dot(${sh(4)}, quadratic),
                    dot(${sh(2)}, linear) + dot(${sh(5)}, quadratic)) + ${sh(6)}.rgb * (n.x * n.x - n.y * n.y);
    return max(PI * sum, vec3(0.0));
}
`;

const kFromUniform = `uniform vec4 tetralightSh[7];\n${irradianceFunction(i => `tetralightSh[${i}]`)}`;

/** Where the texels of the instance begin that a vertex shader draws. They follow each other in one row. */
export const kFindTexels = `uniform highp sampler2D tetralightTexture;
ivec2 tetralightPlace() {
    #ifdef USE_BATCHING
        int instance = int(getIndirectIndex(gl_DrawID));
    #else
        int instance = gl_InstanceID;
    #endif
    int place = 7 * instance;
    int width = textureSize(tetralightTexture, 0).x;
    return ivec2(place % width, place / width);
}
`;

// One varying and seven reads a pixel are faster than seven reads a vertex and as many varyings.
const kVarying = 'flat varying ivec2 vTetralightPlace;\n';
const kFromTexture = `uniform highp sampler2D tetralightTexture;\n${kVarying}` +
    irradianceFunction(i => `texelFetch(tetralightTexture, vTetralightPlace + ivec2(${i}, 0), 0)`);

/** A copy of a material that is lit from `source`, too. What it did before it compiled stays. */
export function litCopy(material: three.Material, source: LightSource): three.Material {
    const copy = material.clone();
    const kind = 'sh' in source ? 'uniform' : 'texture';
    copy.onBeforeCompile = (shader, renderer) => {
        material.onBeforeCompile.call(copy, shader, renderer);
        if ('sh' in source) shader.uniforms.tetralightSh = {value: source.sh};
        else shader.uniforms.tetralightTexture = {value: source.texture};
        patch(shader, kind);
    };
    copy.customProgramCacheKey = () => `${material.customProgramCacheKey()} tetralight ${kind}`;
    return copy;
}

function patch(shader: {vertexShader: string; fragmentShader: string}, kind: 'uniform' | 'texture'): void {
    shader.fragmentShader = shader.fragmentShader
        .replace('void main() {', `${kind === 'uniform' ? kFromUniform : kFromTexture}void main() {`)
        .replace('#include <lights_fragment_begin>',
                 `#include <lights_fragment_begin>
    irradiance += tetralightIrradiance(normalize((vec4(geometryNormal, 0.0) * viewMatrix).xyz));`);
    if (kind === 'uniform') return;
    shader.vertexShader = shader.vertexShader
        .replace('void main() {', `${kVarying}${kFindTexels}void main() {\n    vTetralightPlace = tetralightPlace();\n`);
}
