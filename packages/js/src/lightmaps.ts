// SPDX-License-Identifier: Apache-2.0
// Lightmaps: baked light of static surfaces as texels of square pages (docs/file_format.md).
import {argumentError, sectionError} from './error.js';
import {floatOfHalf} from './half.js';
import {changedWeights, LayerWeights} from './layers.js';
import {FileData, SectionFile} from './section_file.js';
import {readNames} from './section_text.js';
import {verifyLightmaps} from './verify_lightmaps.js';

const kLightmapFile = {magic: 'TETRALM\n', version: 1, name: 'lightmap file'};

/** Where an instance of the scene is in the pages: a UV of its mesh, times `scale`, plus `offset`. */
export interface LightmapRectangle {
    scale: readonly [number, number];
    offset: readonly [number, number];
    /** `kNone`: the instance takes its light from probes. */
    page: number;
    x: number;
    y: number;
    width: number;
    height: number;
    /** Index into `meshes`, or `kNone`. */
    mesh: number;
}

/** The unwrapped UVs of one packing of a mesh. */
export interface LightmapMesh {
    /** Hash of positions and indices. */
    geometryKey: bigint;
    /** Index of its first corner in `cornerUvs`. */
    firstCorner: number;
    triangleCount: number;
}

export interface LightmapLayer {
    name: string;
    /** 1 = as it was baked. */
    weight: number;
    /** Of its halves. */
    scale: number;
}

/**
 * Texels are ordered by page, then row, then column; row 0 is at v = 0. Light is a half times `scale`, in the units of the
 * lights, not divided by π. Arrays of what a file does not have are empty.
 */
export interface Lightmaps {
    pageSize: number;
    pageCount: number;
    texelsPerMeter: number;
    scale: number;
    mixedLighting: 'indirect' | 'shadowmask' | 'subtractive';
    ambientOcclusionDistance: number;
    /** 4 halves a texel: RGB irradiance on its normal; coverage, which is not scaled. */
    irradiance: Uint16Array;
    /** 12 halves a texel: φ of three channels, then three world axes of v of each channel. For normal maps. */
    light: Uint16Array;
    /** Of 255. */
    validity: Uint8Array;
    /** A half a texel: relative standard error. */
    error: Uint16Array;
    /** 4 channels a texel, of 255. */
    shadowMask: Uint8Array;
    /** Of 255. */
    ambientOcclusion: Uint8Array;
    /** One an instance of the scene. */
    rectangles: LightmapRectangle[];
    instanceNames: string[];
    meshes: LightmapMesh[];
    /** 2 floats a corner, three corners a triangle. */
    cornerUvs: Float32Array;
    layers: LightmapLayer[];
    /** 3 halves a texel, layer after layer. */
    layerIrradiance: Uint16Array;
    /** As `light`, layer after layer. */
    layerLight: Uint16Array;
    metadata: string;
}

/** Opens a `.lightmaps` file, as `read` opens a `.probes` file. */
export function readLightmaps(data: FileData): Lightmaps {
    const file = new SectionFile(kLightmapFile, data);
    const {info, words} = readInfo(file);
    const rectangles = file.words('rectangles', 12);
    const meshes = file.words('meshes', 6);
    const layers = file.words('layers', 4);
    const layerNames = readNames(file, 'layer_names');
    const lightmaps: Lightmaps = {
        ...info,
        irradiance: file.halves('irradiance', 4),
        light: file.halves('light', 12),
        validity: file.octets('validity', 1),
        error: file.halves('error', 1),
        shadowMask: file.octets('shadow_mask', 4),
        ambientOcclusion: file.octets('ambient_occlusion', 1),
        rectangles: readRectangles(rectangles),
        instanceNames: readNames(file, 'instance_names'),
        meshes: readMeshes(meshes),
        cornerUvs: file.floats('corner_uvs', 2),
        layers: readLayers(layers, layerNames),
        layerIrradiance: file.halves('layer_irradiance', 3),
        layerLight: file.halves('layer_light', 12),
        metadata: file.text('metadata'),
    };
    const reserved = {info: {words, from: 6, each: 16}, rectangles: {words: rectangles, from: 10, each: 12},
                      meshes: {words: meshes, from: 4, each: 6}, layers: {words: layers, from: 2, each: 4}};
    verifyLightmaps(lightmaps, layerNames, reserved);
    return lightmaps;
}

/**
 * Irradiance of all texels as floats: RGB and coverage of each. With `weights` it is the sum of the layers of the bake,
 * some of whose weights are changed.
 */
export function lightmapIrradiance(lightmaps: Lightmaps, weights?: LayerWeights): Float32Array {
    const {irradiance, layers, layerIrradiance, scale} = lightmaps;
    const floats = new Float32Array(irradiance.length);
    for (let i = 0; i < floats.length; ++i) floats[i] = floatOfHalf(irradiance[i]) * (i % 4 === 3 ? 1 : scale);
    if (!weights) return floats;
    if (layerIrradiance.length === 0) throw argumentError('weights', 'change nothing: the lightmaps hold no layers');
    const changed = changedWeights(layers.map(layer => layer.name), layers.map(layer => layer.weight), weights);
    const texels = irradiance.length / 4;
    for (let i = 0; i < texels; ++i) {
        for (let channel = 0; channel < 3; ++channel) {
            let sum = 0;
            layers.forEach((layer, k) => {
                sum += changed[k] * layer.scale * floatOfHalf(layerIrradiance[3 * (k * texels + i) + channel]);
            });
            floats[4 * i + channel] = sum;
        }
    }
    return floats;
}

const kMixedLighting = ['indirect', 'shadowmask', 'subtractive'] as const;

function readInfo(file: SectionFile) {
    if (!file.has('info')) throw sectionError('info', 'is missing');
    const words = file.words('info', 16);
    if (words.length !== 16) throw sectionError('info', `${words.length / 16} elements instead of 1`);
    const floats = floatsOf(words);
    const info = {
        pageSize: words[0], pageCount: words[1], texelsPerMeter: floats[2], scale: floats[3],
        mixedLighting: kMixedLighting[words[4]], ambientOcclusionDistance: floats[5],
    };
    return {info, words};
}

const floatsOf = (words: Uint32Array) => new Float32Array(words.buffer, words.byteOffset, words.length);

function readRectangles(words: Uint32Array): LightmapRectangle[] {
    const floats = floatsOf(words);
    return Array.from({length: words.length / 12}, (_, i) => {
        const at = 12 * i;
        const [page, x, y, width, height, mesh] = words.subarray(at + 4, at + 10);
        return {scale: [floats[at], floats[at + 1]], offset: [floats[at + 2], floats[at + 3]], page, x, y, width, height,
                mesh};
    });
}

function readMeshes(words: Uint32Array): LightmapMesh[] {
    return Array.from({length: words.length / 6}, (_, i) => {
        const [low, high, firstCorner, triangleCount] = words.subarray(6 * i, 6 * i + 4);
        return {geometryKey: BigInt(low) | BigInt(high) << 32n, firstCorner, triangleCount};
    });
}

function readLayers(words: Uint32Array, names: readonly string[]): LightmapLayer[] {
    const floats = floatsOf(words);
    return Array.from({length: words.length / 4},
                      (_, i) => ({name: names[i] ?? '', weight: floats[4 * i], scale: floats[4 * i + 1]}));
}
