// SPDX-License-Identifier: Apache-2.0
// The lights that a volume was baked with: what a runtime needs to add their direct light (docs/mixed_lighting.md).
import {kLightSize, kNone, VolumeData} from './volume_data.js';

const kTypes = ['directional', 'point', 'spot', 'rectangle', 'disc'] as const;
const kModes = ['mixed', 'baked', 'realtime'] as const;
const kMixedLighting = ['indirect', 'shadowmask', 'subtractive'] as const;

type Vec3 = readonly [number, number, number];

export interface BakedLight {
    name: string;
    type: typeof kTypes[number];
    /** Mixed: probes have its bounces. Baked: its direct light, too. Realtime: nothing. */
    mode: typeof kModes[number];
    /** Lux of directional lights, candela of the others; RGB. */
    intensity: Vec3;
    position: Vec3;
    /** In which it shines. */
    direction: Vec3;
    /** Metres; 0: without end. */
    range: number;
    cosInnerCone: number;
    cosOuterCone: number;
    mixedLighting: typeof kMixedLighting[number];
    /** The channel of occlusion that is this light's. */
    channel: number | undefined;
    /** The index of the layer of its light. */
    layer: number | undefined;
}

export function readBakedLights({lights, lightNames, lightStates}: VolumeData): BakedLight[] {
    return Array.from({length: lights.byteLength / kLightSize}, (_, i) => {
        const at = i * kLightSize;
        const number = (offset: number) => lights.getFloat32(at + offset, true);
        const vector = (offset: number): Vec3 => [number(offset), number(offset + 4), number(offset + 8)];
        const state = lightStates.length > 0 ? lightStates.subarray(4 * i, 4 * i + 4) : [0, kNone, kNone, 0];
        const index = (value: number) => value === kNone ? undefined : value;
        return {
            name: lightNames[i] ?? '',
            type: kTypes[lights.getUint32(at, true)], mode: kModes[lights.getUint32(at + 4, true)],
            intensity: vector(8), position: vector(20), direction: vector(32), range: number(44),
            cosInnerCone: number(48), cosOuterCone: number(52),
            mixedLighting: kMixedLighting[state[0]], channel: index(state[1]), layer: index(state[2]),
        };
    });
}

/** The factor of a light's bounces. */
export const indirectMultiplier = ({lights}: VolumeData, light: number) => lights.getFloat32(light * kLightSize + 60, true);
