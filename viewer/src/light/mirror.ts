// SPDX-License-Identifier: Apache-2.0
// Reflection probes on surfaces (docs/reflections.md, "How they are used"): what render/mirror.h shows, by
// runtime/shaders/reflection.glsl in three's materials.
import {kPacked, packSh, ReflectionProbe, Reflections} from 'tetralight';
import * as three from 'three';

import reflection from '../../../runtime/shaders/reflection.glsl?raw';
import {ReflectionBalls} from './reflection_balls';
import {hasBox, probesNear} from './reflections';
import {addPosition, setMirrorShader, Shader, shShader, uniformsOf} from './shaders';
import {kTableSize, splitSumTable} from './split_sum';

/** Of a mesh: fragment shaders have 16 textures at least, and other light needs some. */
const kMostCubes = 6;

/** Factors of a material of glTF; its texture has roughness in green and metalness in blue. */
export interface Shine {
    metalness: number;
    roughness: number;
    map: three.Texture | null;
}

/** A mesh, or instances that all lie in a box. */
export interface ShinySurface {
    material: three.Material;
    /** 'instances': each has metalness and roughness in the attribute `shine`. */
    shine: Shine | 'instances';
    box: () => three.Box3;
}

/** TetralightReflectionProbe of runtime/shaders/reflection.glsl. */
type ProbeConstants = Record<'position' | 'box_center' | 'half_size' | 'x_axis' | 'y_axis' | 'z_axis', three.Vector4>;

/** What surfaces mirror. */
export class Mirror {
    private readonly cubes: three.CubeTexture[];
    private readonly count: number;  // of cubes of a mesh
    private readonly table = tableTexture();

    constructor(private readonly reflections: Reflections) {
        this.cubes = reflections.probes.map((_, probe) => cubeTexture(reflections, probe));
        this.count = Math.min(kMostCubes, reflections.probes.length);
    }

    get probes(): ReflectionProbe[] {
        return this.reflections.probes;
    }

    /** Returns a function that chooses the probes again, for surfaces that have moved. */
    showOn({material, shine, box}: ShinySurface): () => void {
        const choose = () => this.choose(box(), material);
        choose();
        const map = shine === 'instances' ? null : shine.map;
        map?.updateMatrix();
        setUniforms(material, {
            reflectionLevels: this.reflections.levelCount - 1, splitSumTable: this.table,
            ...shine === 'instances' ? {} : {shineFactors: new three.Vector2(shine.metalness, shine.roughness)},
            ...map === null ? {} : {shineMap: map, metalnessMapTransform: map.matrix},
        });
        Object.assign(material, {metalnessMap: map});  // three then gives the shader its UVs
        const kind = shine === 'instances' ? 'instances' : map === null ? 'factors' : 'map';
        setMirrorShader(material, {
            key: `${this.count} ${kind}`,
            change: shader => addMirror(shader, this.count, kind),
        });
        return choose;
    }

    /** Balls that show what the cubes hold. */
    balls(radius: number): ReflectionBalls {
        return new ReflectionBalls(this.reflections, this.cubes, radius);
    }

    dispose(): void {
        for (const cube of this.cubes) cube.dispose();
        this.table.dispose();
    }

    private choose(box: three.Box3, material: three.Material): void {
        const {probes} = this.reflections;
        const chosen = probesNear(probes, box, this.count);
        setUniforms(material, {
            reflectionCubes: chosen.map(probe => this.cubes[probe]),
            reflectionProbes: chosen.map(probe => constantsOf(probes[probe], probe)),
            reflectionSh: chosen.flatMap(probe => packedSh(probes[probe])),
        });
    }
}

function setUniforms(material: three.Material, values: Record<string, unknown>): void {
    const uniforms = uniformsOf(material);
    for (const [name, value] of Object.entries(values)) {
        if (uniforms[name] === undefined) uniforms[name] = {value};
        else uniforms[name].value = value;
    }
}

/** Shows surfaces without reflections. */
export function hideMirror(material: three.Material): void {
    Object.assign(material, {metalnessMap: null});
    setMirrorShader(material, null);
}

/** The twin of `make_shader_reflection_probe` of runtime/shader_reflections.h. */
function constantsOf(probe: ReflectionProbe, index: number): ProbeConstants {
    const {position, boxCenter, halfSize, axes, blendDistance} = probe;
    const isBoxed = hasBox(probe);
    const vector = ([x, y, z]: readonly number[], w: number) => new three.Vector4(x, y, z, w);
    const ofBox = (v: readonly number[], w = 0) => vector(isBoxed ? v : [0, 0, 0], w);
    return {
        position: vector(position, index), box_center: ofBox(boxCenter, blendDistance),
        half_size: ofBox(halfSize, Number(isBoxed)),
        x_axis: ofBox(axes.slice(0, 3)), y_axis: ofBox(axes.slice(3, 6)), z_axis: ofBox(axes.slice(6, 9)),
    };
}

function packedSh({sh}: ReflectionProbe): three.Vector4[] {
    const packed = new Float32Array(kPacked);
    packSh(sh, 0, packed, 0);
    return Array.from({length: 7}, (_, i) => new three.Vector4().fromArray(packed, 4 * i));
}

/** three takes level 0 from the texture's images, and smaller levels from its mipmaps. */
function cubeTexture({size, levelCount, texels}: Reflections, probe: number): three.CubeTexture {
    const level = (i: number) => facesOf(texels(probe, i)).map(face => new three.DataTexture(
        face, size >> i, size >> i, three.RGBAFormat, three.HalfFloatType));
    const texture = new three.CubeTexture(level(0));
    texture.format = three.RGBAFormat;
    texture.type = three.HalfFloatType;
    texture.colorSpace = three.NoColorSpace;
    texture.magFilter = three.LinearFilter;
    texture.minFilter = levelCount > 1 ? three.LinearMipmapLinearFilter : three.LinearFilter;
    texture.generateMipmaps = false;
    const smaller = Array.from({length: levelCount - 1}, (_, i) => ({image: level(i + 1)}));
    texture.mipmaps = smaller as unknown as typeof texture.mipmaps;
    texture.needsUpdate = true;
    return texture;
}

function facesOf(cube: Uint16Array): Uint16Array<ArrayBuffer>[] {
    const each = cube.length / 6;
    return Array.from({length: 6}, (_, face) => cube.subarray(face * each, (face + 1) * each) as Uint16Array<ArrayBuffer>);
}

function tableTexture(): three.DataTexture {
    const halves = Uint16Array.from(splitSumTable(), three.DataUtils.toHalfFloat);
    const texture = new three.DataTexture(halves, kTableSize, kTableSize, three.RGFormat, three.HalfFloatType);
    texture.minFilter = texture.magFilter = three.LinearFilter;
    texture.needsUpdate = true;
    return texture;
}

/** Metalness and roughness of a pixel. */
const kShine = {
    instances: {declarations: 'varying vec2 instanceShine;\n', value: 'instanceShine'},
    factors: {declarations: 'uniform vec2 shineFactors;\n', value: 'shineFactors'},
    map: {declarations: 'uniform vec2 shineFactors;\nuniform sampler2D shineMap;\n',
          value: 'shineFactors * texture2D(shineMap, vMetalnessMapUv).bg'},
};

/** The twin of render/gl/detail/reflection_shader.cpp, with one cube after the other. */
const declarationsOf = (count: number) => `
#define REFLECTIONS ${count}
uniform highp samplerCube reflectionCubes[REFLECTIONS];
uniform TetralightReflectionProbe reflectionProbes[REFLECTIONS];  // in the order in which they cover each other
uniform vec4 reflectionSh[7 * REFLECTIONS];
uniform float reflectionLevels;
uniform highp sampler2D splitSumTable;

// The probe whose box is the nearest; of those at the same distance, the first of the file.
float nearestReflection(vec3 place) {
    int nearest = 0;
    float nearestSquare = 1e38;
    for (int i = 0; i < REFLECTIONS; ++i) {
        TetralightReflectionProbe probe = reflectionProbes[i];
        vec3 beyond = max(abs(tetralight_place_in_box(probe, place)) - probe.half_size.xyz, 0.0);
        float square = dot(beyond, beyond);
        bool isFirst = probe.position.w < reflectionProbes[nearest].position.w;
        if (square > nearestSquare || (square == nearestSquare && !isFirst)) continue;
        nearest = i;
        nearestSquare = square;
    }
    return float(nearest);
}

TetralightReflectionChoice chooseReflections(vec3 place) {
    TetralightReflectionChoice choice = tetralight_no_reflection();
    for (int i = 0; i < REFLECTIONS; ++i) {
        choice = tetralight_add_reflection(
            choice, float(i), tetralight_reflection_influence(reflectionProbes[i], place));
    }
    if (choice.weights.x > 0.0) return choice;
    choice.weights.x = 1.0;
    choice.probes.x = nearestReflection(place);
    return choice;
}

vec3 reflectionIrradiance(int i, vec3 normal) {
    return tetralight_sample_sh9(TetralightPackedSh(
        reflectionSh[7 * i], reflectionSh[7 * i + 1], reflectionSh[7 * i + 2], reflectionSh[7 * i + 3],
        reflectionSh[7 * i + 4], reflectionSh[7 * i + 5], reflectionSh[7 * i + 6]), normal);
}

// What a surface mirrors. baked: irradiance / pi at the place.
vec3 mirroredLight(vec3 place, vec3 normal, vec3 f0, float roughness, vec3 baked) {
    vec3 toEye = normalize(cameraPosition - place);
    TetralightReflectionChoice choice = chooseReflections(place);
    vec3 weights = tetralight_reflection_weights(choice);
    float level = tetralight_reflection_level(roughness, reflectionLevels);
    vec3 mirrored = reflect(-toEye, normal);
    vec3 seen = vec3(0.0), atProbes = vec3(0.0);
    float weight;
${Array.from({length: count}, (_, i) => `
    weight = dot(weights, vec3(equal(choice.probes.xyz, vec3(${i}.0))));
    if (weight > 0.0) {
        seen += weight * tetralight_sample_reflection_cube(reflectionCubes[${i}], reflectionProbes[${i}],
                                                           place, mirrored, level);
        atProbes += weight * reflectionIrradiance(${i}, normal);
    }`).join('')}
    vec2 terms = tetralight_split_sum(splitSumTable, max(dot(normal, toEye), 0.0), roughness);
    return seen * (f0 * terms.x + terms.y) * tetralight_reflection_occlusion(baked, atProbes, roughness);
}
`;

/** Surfaces are diffuse by their base color and metalness, and mirror besides. */
function addMirror(shader: Shader, count: number, kind: keyof typeof kShine): void {
    addPosition(shader);
    if (kind === 'instances') {
        shader.vertexShader = 'attribute vec2 shine;\nvarying vec2 instanceShine;\n' + shader.vertexShader.replace(
            '#include <begin_vertex>', '#include <begin_vertex>\ninstanceShine = shine;\n');
    }
    const {declarations, value} = kShine[kind];
    const library = (shader.fragmentShader.includes(shShader) ? '' : shShader) + reflection;
    shader.fragmentShader = shader.fragmentShader
        .replace('void main() {', () => `${library}${declarations}${declarationsOf(count)}void main() {`)
        .replace('#include <lights_lambert_fragment>', () => `
            vec2 metalAndRough = ${value};
            vec3 mirrorF0 = tetralight_specular_f0(diffuseColor.rgb, metalAndRough.x);
            diffuseColor.rgb *= 0.96 * (1.0 - metalAndRough.x);
            #include <lights_lambert_fragment>`)
        .replace('#include <lights_fragment_end>', () => `
            vec3 mirrorNormal = inverseTransformDirection(normal, viewMatrix);
            vec3 mirrored = mirroredLight(probePosition, mirrorNormal, mirrorF0, metalAndRough.y, irradiance / PI);
            #include <lights_fragment_end>`)
        .replace('#include <envmap_fragment>', 'outgoingLight += mirrored;\n#include <envmap_fragment>');
}
