// SPDX-License-Identifier: Apache-2.0
export {ambientSh, skyOf} from './ambient_sh.js';
export type {SkyOfLight} from './ambient_sh.js';
export {ProbeVolume} from './probe_volume.js';
export type {ObjectOptions as ProbeVolumeOptions} from '../moving_light.js';
