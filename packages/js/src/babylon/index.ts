// SPDX-License-Identifier: Apache-2.0
export {positionInVolume, shInScene} from './frame.js';
export type {Handedness} from './frame.js';
export {ProbePlugin} from './probe_plugin.js';
export {ProbeVolume} from './probe_volume.js';
export {sphericalPolynomial} from './spherical_polynomial.js';
export type {ObjectOptions as ProbeVolumeOptions} from '../moving_light.js';
