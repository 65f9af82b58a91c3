// SPDX-License-Identifier: Apache-2.0
import {checkCount, checkEach, kLargestCoefficient} from './checks.js';
import {elementError, sectionError} from './error.js';
import {checkDistinctNames} from './section_text.js';
import {kLightSize, kNone, VolumeData} from './volume_data.js';

// Products of both, which relighting adds, are finite.
const kLargestTransfer = 1e6;
const kLargestSky = 2e31;

const kWindows = 3;  // of dering

/** Light that can change after the bake: layers, transfer, lights and their channels. */
export function checkLayers(v: VolumeData): void {
    checkCounts(v);
    checkDistinctNames('layer_names', v.layerNames);
    checkStates(v);
    const lights = v.lights.byteLength / kLightSize;
    checkEach('occlusion_lights', v.occlusionLights, 4, 'is out of range', light => light < lights || light === kNone);
    v.layers.forEach(({weight, largest, ambient}, i) => {
        const isGood = Number.isFinite(weight) && weight >= 0 && largest >= 0 && largest <= kLargestCoefficient &&
                       ambient.every(x => Math.abs(x) <= kLargestCoefficient);
        if (!isGood) throw elementError('layers', i, 'is out of range');
    });
    checkEach('layer_irradiance', v.layerIrradiance, 27, 'is not finite, or above 1e37',
              x => Math.abs(x) <= kLargestCoefficient);
    checkEach('layer_errors', v.layerErrors, 1, 'is out of range', error => error >= 0 && Number.isFinite(error));
    checkEach('transfer', v.transfer, 576, 'is not finite, or above 1e6', x => Math.abs(x) <= kLargestTransfer);
    checkEach('sky', v.sky, 48, 'is not finite, or above 2e31', x => Math.abs(x) <= kLargestSky);
    checkEach('dering', v.dering, 1, 'is out of range', window => window <= kWindows);
    checkBounds(v);
}

function checkCounts(v: VolumeData): void {
    const probes = v.positions.length / 3;
    const layers = v.layers.length;
    if (v.layerNames.length !== layers) {
        throw sectionError('layer_names', `${v.layerNames.length} names for ${layers} layers`);
    }
    checkCount('light_states', v.lightStates.length / 4, v.lights.byteLength / kLightSize);
    checkCount('occlusion_lights', v.occlusionLights.length / 4, probes);
    checkCount('layer_irradiance', v.layerIrradiance.length / 27, layers * probes);
    checkCount('layer_errors', v.layerErrors.length, layers * probes);
    checkCount('transfer', v.transfer.length / 576, probes);
    checkCount('sky', v.sky.length / 48, 1);
    checkCount('dering', v.dering.length, probes);
}

function checkStates({lightStates, layers}: VolumeData): void {
    for (let at = 0; at < lightStates.length; at += 4) {
        const [mode, channel, layer, fellBack] = lightStates.subarray(at, at + 4);
        const isState = mode <= 2 && (channel < 4 || channel === kNone) &&
                        (layer < layers.length || layer === kNone) && fellBack <= 1;
        if (!isState) throw elementError('light_states', at / 4, 'is out of range');
    }
}

/** The bound of each layer holds: sums of layers are finite because of it. */
function checkBounds({layers, layerIrradiance}: VolumeData): void {
    const each = layers.length === 0 ? 0 : layerIrradiance.length / layers.length;
    layers.forEach(({largest}, k) => {
        for (let i = k * each; i < (k + 1) * each; ++i) {
            const size = Math.abs(layerIrradiance[i]);
            if (size > largest) throw elementError('layers', k, `has a coefficient of ${size}, but its bound is ${largest}`);
        }
    });
}
