// SPDX-License-Identifier: Apache-2.0
export {ProbeVolume} from './probe_volume.js';
export type {ProbeVolumeOptions} from './probe_volume.js';
