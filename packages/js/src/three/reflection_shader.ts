// SPDX-License-Identifier: Apache-2.0
// Adds reflection probes to the radiance that standard and physical materials of three.js mirror (docs/reflections.md, "How
// they are used").
import * as three from 'three';

import {packSh} from '../sh.js';
import type {ReflectionProbe} from '../reflections.js';
import {irradianceFunction} from './light_shader.js';

/** Probes that one mesh can mirror. */
export const kMostCubes = 3;

const kCubes = Array.from({length: kMostCubes}, (_, i) => i);

/** Uniforms of the probes of a mesh, in the order in which they cover each other. */
export interface ReflectionUniforms {
    cubes: three.CubeTexture[];
    /** Eight vec4 a probe; see `setProbe`. */
    probes: Float32Array;
    /** Seven vec4 a probe, of `packSh`. */
    sh: Float32Array;
    count: {value: number};
    /** Number of levels - 1. */
    lastLevel: number;
}

const kVectors = 6;  // vec4 of a probe in `probes`

/** Writes probe k: its position, box, blend distance and irradiance. */
export function setProbe(uniforms: ReflectionUniforms, k: number, probe: ReflectionProbe): void {
    const {position, boxCenter, halfSize, axes, blendDistance, sh} = probe;
    const hasBox = Number.isFinite(halfSize[0]);
    uniforms.probes.set([
        ...position, 0, ...boxCenter, blendDistance, ...(hasBox ? [...halfSize, 1] : [0, 0, 0, 0]),
        ...axes.slice(0, 3), 0, ...axes.slice(3, 6), 0, ...axes.slice(6, 9), 0,
    ], 4 * kVectors * k);
    packSh(sh, 0, uniforms.sh.subarray(28 * k, 28 * k + 28), 0);
}

const kShader = `
uniform samplerCube tetralightCubes[${kMostCubes}];
uniform vec4 tetralightProbes[${kVectors * kMostCubes}];
uniform vec4 tetralightCubeSh[${7 * kMostCubes}];
uniform int tetralightCubeCount;
uniform float tetralightLastLevel;

vec3 tetralightPlaceInBox(int at, vec3 place) {
    vec3 v = place - tetralightProbes[at].xyz - tetralightProbes[at + 1].xyz;
    return vec3(dot(v, tetralightProbes[at + 3].xyz), dot(v, tetralightProbes[at + 4].xyz), dot(v, tetralightProbes[at + 5].xyz));
}

// Walls on the sides of a box count as inside it, however their positions are rounded.
float tetralightDistanceToBox(int at, vec3 place) {
    if (tetralightProbes[at + 2].w == 0.0) return 0.0;
    return length(max(abs(tetralightPlaceInBox(at, place)) - 1.001 * tetralightProbes[at + 2].xyz, 0.0));
}

float tetralightInfluence(int at, vec3 place) {
    float outside = tetralightDistanceToBox(at, place);
    float blend = tetralightProbes[at + 1].w;
    if (outside == 0.0) return 1.0;
    if (!(outside < blend)) return 0.0;
    float t = 1.0 - outside / blend;
    return t * t * (3.0 - 2.0 * t);
}

// The direction from the probe to where a ray ends at a side of the box.
vec3 tetralightProjectOnBox(int at, vec3 place, vec3 direction) {
    float influence = tetralightProbes[at + 2].w == 0.0 ? 0.0 : tetralightInfluence(at, place);
    if (influence == 0.0) return direction;
    vec3 halfSize = tetralightProbes[at + 2].xyz;
    mat3 worldFromBox = mat3(tetralightProbes[at + 3].xyz, tetralightProbes[at + 4].xyz, tetralightProbes[at + 5].xyz);
    vec3 begin = clamp(tetralightPlaceInBox(at, place), -halfSize, halfSize);
    vec3 along = direction * worldFromBox;
    vec3 reach = (halfSize - begin * sign(along)) / max(abs(along), vec3(1e-20));
    vec3 hit = begin + along * min(reach.x, min(reach.y, reach.z));
    vec3 fromProbe = tetralightProbes[at + 1].xyz + worldFromBox * hit;
    float square = dot(fromProbe, fromProbe);
    if (!(square > 0.0)) return direction;
    return normalize(mix(direction, fromProbe * inversesqrt(square), influence));
}

${kCubes.map(k => irradianceFunction(i => `tetralightCubeSh[${7 * k + i}]`)
    .replace('tetralightIrradiance', `tetralightIrradianceOfCube${k}`)).join('')}

// What a rough surface mirrors is as dark as its own baked light, if there is any, against that at the probes.
float tetralightOcclusion(vec3 here, vec3 there, float roughness) {
    const vec3 luminance = vec3(0.2126, 0.7152, 0.0722);
    float ours = dot(here, luminance);
    float theirs = dot(there, luminance);
    if (!(theirs > 0.0) || ours == 0.0) return 1.0;
    return mix(1.0, clamp(ours / theirs, 0.0, 1.0), smoothstep(0.1, 0.5, roughness));
}

vec3 tetralightMirrored(vec3 place, vec3 normal, vec3 mirrored, float roughness, vec3 irradiance) {
    float weights[${kMostCubes}];
    float uncovered = 1.0, nearest = 1e38;
    int first = 0;
    for (int k = 0; k < ${kMostCubes}; ++k) {
        float influence = k < tetralightCubeCount ? tetralightInfluence(${kVectors} * k, place) : 0.0;
        weights[k] = min(influence, uncovered);
        uncovered -= weights[k];
        float outside = k < tetralightCubeCount ? tetralightDistanceToBox(${kVectors} * k, place) : 1e38;
        if (outside < nearest) { nearest = outside; first = k; }
    }
    if (uncovered == 1.0) { weights[first] = 1.0; uncovered = 0.0; }
    float level = clamp(roughness, 0.0, 1.0) * (2.0 - clamp(roughness, 0.0, 1.0)) * tetralightLastLevel;
    vec3 seen = vec3(0.0), atProbes = vec3(0.0);
    float weight;
${kCubes.map(k => `
    weight = weights[${k}] / (1.0 - uncovered);
    if (weight > 0.0) {
        seen += weight * textureLod(tetralightCubes[${k}], tetralightProjectOnBox(${kVectors * k}, place, mirrored), level).rgb;
        atProbes += weight * tetralightIrradianceOfCube${k}(normal);
    }`).join('')}
    return seen * tetralightOcclusion(irradiance, atProbes, roughness);
}
`;

const kAddRadiance = `
{
    vec3 tetralightPlace = (vec4(-vViewPosition, 0.0) * viewMatrix).xyz + cameraPosition;
    vec3 tetralightNormal = inverseTransformDirection(geometryNormal, viewMatrix);
    vec3 tetralightDirection = inverseTransformDirection(reflect(-geometryViewDir, geometryNormal), viewMatrix);
    radiance += tetralightMirrored(tetralightPlace, tetralightNormal, tetralightDirection, roughnessFactor, irradiance);
}
#include <lights_fragment_end>`;

/** A copy of a material that mirrors probes, too. */
export function mirrorCopy(material: three.Material, uniforms: ReflectionUniforms): three.Material {
    const copy = material.clone();
    copy.onBeforeCompile = (shader, renderer) => {
        material.onBeforeCompile.call(copy, shader, renderer);
        Object.assign(shader.uniforms, {
            tetralightCubes: {value: uniforms.cubes}, tetralightProbes: {value: uniforms.probes},
            tetralightCubeSh: {value: uniforms.sh}, tetralightCubeCount: uniforms.count,
            tetralightLastLevel: {value: uniforms.lastLevel},
        });
        shader.fragmentShader = shader.fragmentShader.replace('void main() {', () => `${kShader}void main() {`)
            .replace('#include <lights_fragment_end>', () => kAddRadiance);
    };
    copy.customProgramCacheKey = () => `${material.customProgramCacheKey()} tetralight mirror`;
    return copy;
}
