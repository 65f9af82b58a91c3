// SPDX-License-Identifier: Apache-2.0
// Baked light at any position:
//
//     const volume = read(await (await fetch('court.probes')).arrayBuffer());
//     const light = volume.light([0, 1.5, 0]);
//     const [red, green, blue] = irradiance(light.sh, [0, 1, 0]);
export type {BakedLight} from './baked_lights.js';
export type {BatchOptions, BatchOutputs} from './batch.js';
export type {Precision} from './blend.js';
export {constantSky, distantSun, kDistantCoefficients} from './distant_light.js';
export {TetralightError} from './error.js';
export type {ErrorCode} from './error.js';
export type {LayerWeights} from './layers.js';
export {lightmapIrradiance, readLightmaps} from './lightmaps.js';
export type {LightmapLayer, LightmapMesh, LightmapRectangle, Lightmaps} from './lightmaps.js';
export type {ProbeHealth} from './probe_health.js';
export type {Outside, QueryOptions} from './query_options.js';
export {levelRoughness, readReflections} from './reflections.js';
export type {ReflectionLayer, ReflectionProbe, Reflections} from './reflections.js';
export {kNone} from './section_file.js';
export type {FileData} from './section_file.js';
export {irradiance, kCoefficients, kPacked, packSh} from './sh.js';
export type {Vector} from './sh.js';
export {read, Volume} from './volume.js';
export type {Layer, Light, Location, ReadOptions} from './volume.js';
export {Dimension} from './volume_data.js';
export type {VolumeData, VolumeInfo} from './volume_data.js';
