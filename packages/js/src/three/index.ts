// SPDX-License-Identifier: Apache-2.0
export {readLightProbeGrid, toLightProbeGrid, VolumeGrid} from './light_probe_grid.js';
export type {GridFile} from './light_probe_grid.js';
export {ProbeVolume} from './probe_volume.js';
export type {ProbeVolumeOptions} from './probe_volume.js';
export {ProbeVolumeHelper} from './probe_volume_helper.js';
export type {ProbeVolumeHelperOptions} from './probe_volume_helper.js';
export {SceneLightmaps} from './scene_lightmaps.js';
export {reflectionCube, SceneReflections} from './scene_reflections.js';
