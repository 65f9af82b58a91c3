// SPDX-License-Identifier: Apache-2.0
// The sections of a `.probes` file as arrays, in place: what docs/file_format.md lists. Absent sections are empty.
import {sectionError} from './error.js';
import type {SectionFile} from './section_file.js';
import {kNone} from './section_file.js';
import {readNames} from './section_text.js';
import {kCoefficients} from './sh.js';

export const kProbeFile = {magic: 'TETRAPV\n', version: 1, name: 'probe file'};

/** What cells are: tetrahedra in space, triangles in a plane, segments on a line. */
export enum Dimension { None, Point, Line, Plane, Space }

/** The fixed-size facts of a volume. */
export interface VolumeInfo {
    origin: Float64Array;    // of positions, in the world
    seedCube: Float64Array;  // 4: lowest corner and scale of the curve of `seeds`
    axis: Float64Array;      // normal of a plane, direction of a line
    dimension: Dimension;
    innerCellCount: number;
    radialFraction: number;
    ambient: Float32Array;  // 27
    extent: number;
    compactScale: number;
}

/** One of the parts whose weighted sum is the light. */
export interface StoredLayer {
    weight: number;
    largest: number;  // the largest |coefficient| of any probe
    ambient: Float32Array;
}

export interface VolumeData {
    info: VolumeInfo;
    positions: Float32Array;     // 3 a probe, relative to the origin
    irradiance: Float32Array;    // 27 a probe
    occlusion: Float32Array;     // 4 a probe
    validity: Float32Array;
    health: DataView;            // 24 bytes a probe
    compact: Uint16Array;        // 32 halves a probe
    exactPositions: Float64Array;
    cells: Uint32Array;          // 4 vertices, 4 neighbors
    hullRays: Float32Array;      // 9 a hull cell
    seeds: Uint32Array;          // 4 words each
    seedGrid: Uint32Array;
    visibilityBlocks: Uint32Array;  // 2 words for 32 cells
    cellVisibility: Uint8Array;     // 14 bytes each
    renderingLayers: Uint32Array;
    sources: Uint32Array;        // 3 each
    groupNames: string[];
    lights: DataView;            // 88 bytes each
    lightNames: string[];
    metadata: string;
    lightStates: Uint32Array;    // 4 each
    occlusionLights: Uint32Array;  // 4 a probe
    layers: StoredLayer[];
    layerNames: string[];
    layerIrradiance: Float32Array;  // 27 a probe, layer after layer
    layerErrors: Float32Array;
    transfer: Float32Array;      // 576 a probe
    sky: Float32Array;           // 48
    dering: Uint8Array;
}

export const kHealthSize = 24;
export const kLightSize = 88;
const kInfoSize = 208;
const kLayerSize = 128;
const kTransferFloats = 9 * 16 + 9 * 16 * 3;

export function readVolumeData(file: SectionFile): VolumeData {
    return {
        info: readInfo(file),
        positions: file.floats('positions', 3),
        irradiance: file.floats('irradiance', kCoefficients),
        occlusion: file.floats('occlusion', 4),
        validity: file.floats('validity', 1),
        health: viewOf(file, 'health', kHealthSize),
        compact: file.halves('compact', 32),
        exactPositions: file.doubles('exact_positions', 3),
        cells: file.words('cells', 8),
        hullRays: file.floats('hull_rays', 9),
        seeds: file.words('seeds', 4),
        seedGrid: file.words('seed_grid', 1),
        visibilityBlocks: file.words('visibility_blocks', 2),
        cellVisibility: file.octets('cell_visibility', 14),
        renderingLayers: file.words('rendering_layers', 1),
        sources: file.words('sources', 3),
        groupNames: readNames(file, 'group_names'),
        lights: viewOf(file, 'lights', kLightSize),
        lightNames: readNames(file, 'light_names'),
        metadata: file.text('metadata'),
        lightStates: file.words('light_states', 4),
        occlusionLights: file.words('occlusion_lights', 4),
        layers: readLayers(file),
        layerNames: readNames(file, 'layer_names'),
        layerIrradiance: file.floats('layer_irradiance', kCoefficients),
        layerErrors: file.floats('layer_errors', 1),
        transfer: file.floats('transfer', kTransferFloats),
        sky: file.floats('sky', 48),
        dering: file.octets('dering', 1),
    };
}

/** Vertices of an inner cell; a hull cell has one less. */
export const vertexCount = ({info}: VolumeData, cell: number) => info.dimension - (cell < info.innerCellCount ? 0 : 1);

function viewOf(file: SectionFile, name: string, each: number): DataView {
    const bytes = file.octets(name, each);
    return new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
}

function readInfo(file: SectionFile): VolumeInfo {
    if (!file.has('info')) throw sectionError('info', 'is missing');
    const view = viewOf(file, 'info', kInfoSize);
    if (view.byteLength !== kInfoSize) throw sectionError('info', `${view.byteLength / kInfoSize} elements instead of 1`);
    const start = view.byteOffset;
    return {
        origin: new Float64Array(view.buffer, start, 3),
        seedCube: new Float64Array(view.buffer, start + 24, 4),
        axis: new Float64Array(view.buffer, start + 56, 3),
        dimension: view.getUint32(80, true),
        innerCellCount: view.getUint32(84, true),
        radialFraction: view.getFloat32(88, true),
        ambient: new Float32Array(view.buffer, start + 92, kCoefficients),
        extent: view.getFloat32(200, true),
        compactScale: view.getFloat32(204, true),
    };
}

function readLayers(file: SectionFile): StoredLayer[] {
    const floats = file.floats('layers', kLayerSize / 4);
    const layers: StoredLayer[] = [];
    for (let at = 0; at < floats.length; at += kLayerSize / 4) {
        layers.push({weight: floats[at], largest: floats[at + 1],
                     ambient: floats.subarray(at + 2, at + 2 + kCoefficients)});
    }
    return layers;
}

export {kNone};
