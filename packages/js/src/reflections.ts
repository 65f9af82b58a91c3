// SPDX-License-Identifier: Apache-2.0
// Reflection probes: cubes of radiance, and the boxes where they are used (docs/file_format.md).
import {argumentError, TetralightError} from './error.js';
import {isFiniteHalf} from './half.js';
import {Ktx2Cubes, readKtx2Cubes} from './ktx2.js';
import {decodeText, FileData} from './section_file.js';
import {checkMetadata, splitNames} from './section_text.js';
import {kCoefficients} from './sh.js';

const kProbeSize = 216;
const kLayerSize = 16;

/** How far the products of axes may be from those of unit vectors at right angles. */
const kAxisTolerance = 1e-3;

export interface ReflectionProbe {
    /** Empty: not known. */
    name: string;
    /** Where the light was captured, world. */
    position: readonly number[];
    /** Center of the box relative to the position, world axes, metres. */
    boxCenter: readonly number[];
    /** Half of the box along its axes. Infinite: the probe is used everywhere. */
    halfSize: readonly number[];
    /** Of the box: three unit vectors, nine numbers. */
    axes: readonly number[];
    /** Outside the box the probe fades out over this distance, metres. */
    blendDistance: number;
    /** Probes of higher importance hide those of lower importance. */
    importance: number;
    validity: number;
    /** Irradiance of the cube's light: 27 floats. */
    sh: Float32Array;
}

export interface ReflectionLayer {
    name: string;
    /** 1 = as it was baked. */
    weight: number;
}

export interface Reflections {
    /** Texels along a side of a face of level 0; level k has `size >> k`. */
    size: number;
    levelCount: number;
    probes: ReflectionProbe[];
    /** The cubes of probes are the sum of their layers by these weights. */
    layers: ReflectionLayer[];
    /** Irradiance of each layer of each probe at weight 1: 27 floats, probe after probe. */
    layerIrradiance: Float32Array;
    metadata: string;
    /**
     * RGBA halves of a cube at a level: radiance and 1, face after face (+X, −X, +Y, −Y, +Z, −Z), row after row. With
     * `layer`, those of that layer at weight 1.
     */
    texels(probe: number, level: number, layer?: number): Uint16Array;
}

/** The roughness that a level is blurred for: 0 for level 0, 1 for the last. */
export function levelRoughness(level: number, levelCount: number): number {
    return levelCount < 2 ? 0 : 1 - Math.sqrt(1 - level / (levelCount - 1));
}

/** Opens a `.ktx2` file of reflection probes. It has no checksums: a changed byte can be another light. */
export function readReflections(data: FileData): Reflections {
    const cubes = readKtx2Cubes(data);
    const text = (key: string) => decodeText(key, cubes.values.get(key) ?? new Uint8Array());
    const names = splitNames('tetralightNames', text('tetralightNames'));
    const layers = readLayers(cubes, splitNames('tetralightLayerNames', text('tetralightLayerNames')));
    const count = cubes.cubeCount / (1 + layers.length);
    if (!Number.isInteger(count)) {
        throw corrupt('tetralightLayers',
                      `${cubes.cubeCount} cubes are not those of probes with ${layers.length} layers each`);
    }
    if (names.length !== 0 && names.length !== count) {
        throw corrupt('tetralightNames', `${names.length} names for ${count} probes`);
    }
    const metadata = text('tetralightMetadata');
    checkMetadata(metadata);
    checkTexels(cubes);
    return {
        size: cubes.size, levelCount: cubes.levels.length, probes: readProbes(cubes, count, names), layers, metadata,
        layerIrradiance: readLayerIrradiance(cubes, count * layers.length),
        texels: (probe, level, layer) => texelsOf(cubes, count, layers.length, probe, level, layer),
    };
}

const corrupt = (field: string, what: string) => new TetralightError('corrupt', field, `${field}: ${what}`);

/** The value of a key as `count` structs of `size` bytes, which may begin at any byte. */
function readStructs({values}: Ktx2Cubes, key: string, count: number, size: number): DataView {
    const bytes = values.get(key) ?? new Uint8Array();
    if (bytes.length !== count * size) throw corrupt(key, `has ${bytes.length} bytes instead of ${count * size}`);
    return new DataView(bytes.slice().buffer);
}

function readLayers(cubes: Ktx2Cubes, names: readonly string[]): ReflectionLayer[] {
    const view = readStructs(cubes, 'tetralightLayers', names.length, kLayerSize);
    return names.map((name, i) => {
        const weight = view.getFloat32(i * kLayerSize, true);
        if (!(weight >= 0 && weight < Infinity)) throw corrupt(`layers[${i}].weight`, `${weight} is out of range`);
        const reserved = [4, 8, 12].map(at => view.getUint32(i * kLayerSize + at, true));
        if (reserved.some(word => word !== 0)) throw corrupt(`layers[${i}].reserved`, 'is not zero');
        return {name, weight};
    });
}

function readLayerIrradiance(cubes: Ktx2Cubes, count: number): Float32Array {
    const view = readStructs(cubes, 'tetralightLayerIrradiance', count, 4 * kCoefficients);
    const irradiance = new Float32Array(view.buffer);
    const bad = irradiance.findIndex(value => !Number.isFinite(value));
    if (bad >= 0) throw corrupt(`layer_irradiance[${Math.floor(bad / kCoefficients)}]`, 'is not finite');
    return irradiance;
}

function readProbes(cubes: Ktx2Cubes, count: number, names: readonly string[]): ReflectionProbe[] {
    const key = 'tetralightReflections';
    if (!cubes.values.has(key)) {
        throw new TetralightError('unsupported', key, 'the texture is not of reflection probes: a key is missing');
    }
    const view = readStructs(cubes, key, count, kProbeSize);
    return Array.from({length: count}, (_, i) => {
        const at = i * kProbeSize;
        const floats = (from: number, length: number) =>
            Array.from({length}, (_, k) => view.getFloat32(at + from + 4 * k, true));
        const probe: ReflectionProbe = {
            name: names[i] ?? '',
            position: [0, 8, 16].map(from => view.getFloat64(at + from, true)),
            boxCenter: floats(24, 3), halfSize: floats(36, 3), axes: floats(48, 9),
            blendDistance: view.getFloat32(at + 84, true), importance: view.getInt32(at + 88, true),
            validity: view.getFloat32(at + 92, true), sh: new Float32Array(floats(96, kCoefficients)),
        };
        const problem = probeProblem(probe);
        if (problem) throw corrupt(`probes[${i}].${problem[0]}`, problem[1]);
        if ([204, 208, 212].some(from => view.getUint32(at + from, true) !== 0)) {
            throw corrupt(`probes[${i}].reserved`, 'is not zero');
        }
        return probe;
    });
}

/** The member of a probe that is wrong, and what is wrong with it. */
function probeProblem(probe: ReflectionProbe): [string, string] | undefined {
    const {position, boxCenter, halfSize, axes, blendDistance, validity, sh} = probe;
    const isFinite = (values: readonly number[] | Float32Array) => [...values].every(Number.isFinite);
    const isBox = halfSize.every(x => x === Infinity) || (isFinite(halfSize) && halfSize.every(x => x > 0));
    if (!isFinite(position)) return ['position', 'is not finite'];
    if (!isFinite(boxCenter)) return ['box_center', 'is not finite'];
    if (!isBox) return ['half_size', 'is neither above 0 nor infinite along all three axes'];
    if (!areAxes(axes)) return ['axes', 'are not unit vectors at right angles'];
    if (!(blendDistance >= 0 && blendDistance < Infinity)) return ['blend_distance', `${blendDistance} m is out of range`];
    if (!(validity >= 0 && validity <= 1)) return ['validity', `${validity} is not in [0, 1]`];
    return isFinite(sh) ? undefined : ['irradiance', 'is not finite'];
}

function areAxes(axes: readonly number[]): boolean {
    const product = (i: number, j: number) =>
        axes[3 * i] * axes[3 * j] + axes[3 * i + 1] * axes[3 * j + 1] + axes[3 * i + 2] * axes[3 * j + 2];
    return [0, 1, 2].every(i => [0, 1, 2].every(j => Math.abs(product(i, j) - (i === j ? 1 : 0)) <= kAxisTolerance));
}

function checkTexels({levels}: Ktx2Cubes): void {
    levels.forEach((halves, level) => {
        for (let i = 0; i < halves.length; ++i) {
            if (!isFiniteHalf(halves[i])) throw corrupt(`levels[${level}]`, `texel ${i >> 2} is not finite`);
        }
    });
}

/** Cubes of probes come first, then those of the layers of each probe. */
function texelsOf({size, levels}: Ktx2Cubes, probes: number, layers: number, probe: number, level: number,
                  layer: number | undefined): Uint16Array {
    const isIndex = (index: number, count: number) => Number.isInteger(index) && index >= 0 && index < count;
    if (!isIndex(probe, probes)) throw argumentError('probe', `is ${probe}; there are ${probes}`);
    if (!isIndex(level, levels.length)) throw argumentError('level', `is ${level}; there are ${levels.length}`);
    if (layer !== undefined && !isIndex(layer, layers)) throw argumentError('layer', `is ${layer}; there are ${layers}`);
    const cube = layer === undefined ? probe : probes + probe * layers + layer;
    const each = 4 * 6 * (size >> level) ** 2;
    return levels[level].subarray(cube * each, (cube + 1) * each);
}
