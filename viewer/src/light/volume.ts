// SPDX-License-Identifier: Apache-2.0
// A probe volume of the service, opened in the page.
import {ProbeHealth, read, TetralightError, Volume} from 'tetralight';

import {Bake, StoredFile, titleOf} from '../page/api';
import {kY0} from './radiometry';

export interface OpenVolume {
    file: StoredFile;
    probes: Volume;
    positions: Float32Array;  // world, 3 a probe
    health: ProbeHealth[];    // empty: not known
}

export function openVolume(bytes: ArrayBuffer, file: StoredFile): OpenVolume {
    return opened(file, readVolume(bytes, titleOf(file)));
}

/** The light that a bake has so far. The service does not store it: its id is empty. */
export function previewOf(bake: Bake, bytes: ArrayBuffer): OpenVolume {
    const name = `preview of ${titleOf(bake)}`;
    const file: StoredFile = {id: '', name, names: [name], bytes: bytes.byteLength, created: bake.created, state: 'ready'};
    return opened(file, readVolume(bytes, name));
}

function opened(file: StoredFile, probes: Volume): OpenVolume {
    const {positions, info: {origin}} = probes.data;
    return {file, probes, positions: positions.map((x, i) => x + origin[i % 3]), health: probes.health};
}

/** `name` names the volume in errors. */
export function readVolume(bytes: ArrayBuffer, name: string): Volume {
    try {
        return read(bytes);
    } catch (error) {
        if (!(error instanceof TetralightError)) throw error;
        throw new Error(`the volume ${name} is damaged: ${error.message}`);
    }
}

export const isBaked = (volume: Volume) => volume.irradiance.length > 0;

/** Mean radiance of the sky of the bake, RGB; null: not known. */
export function skyOf({data: {sky}}: Volume): number[] | null {
    return sky.length === 0 ? null : [...sky.subarray(0, 3)].map(value => kY0 * value);
}
