// SPDX-License-Identifier: Apache-2.0
// What can be on a side of a comparison.
import {Bake, StoredFile, titleOf} from '../page/api';

/** Lights that need no other file; all else is the id of a volume. */
export const kOwnSides = {
    open: {title: 'The open volume', says: 'Light of the open volume, with the weights of the tab View.'},
    plain: {title: 'The open volume, walls ignored',
            says: 'Light is interpolated by plain weights: it shines through walls.'},
    ambient: {title: 'No probes: one ambient color',
              says: 'One ambient color, the mean light of all probes, is everywhere the same. ' +
                    'The direct light of lights stays.'},
    none: {title: 'No probes: no ambient light', says: 'Only the direct light of lights.'},
} as const;

export type OwnSide = keyof typeof kOwnSides;

export const isOwnSide = (key: string): key is OwnSide => Object.hasOwn(kOwnSides, key);

/** Volumes of a name are told apart by when they were stored; a newer bake takes the name from an older volume. */
export function volumeTitle(file: StoredFile, open: StoredFile | null, bakes: readonly Bake[]): string {
    const baked = bakes.find(({volume, name}) => volume === file.id && name !== '')?.name;
    const time = new Date(1000 * file.created).toLocaleString('en-GB', {dateStyle: 'medium', timeStyle: 'short'});
    return `${file.name || baked || titleOf(file)}, ${file.id === open?.id ? 'as stored' : time}`;
}

/** The volume of the last bake of the same name before the one that made `open`; without a name, of the same scene. */
export function volumeBefore(open: StoredFile, bakes: readonly Bake[], volumes: readonly StoredFile[]): StoredFile | null {
    const made = bakes.find(({volume}) => volume === open.id);
    if (made === undefined) return null;
    const isSame = (bake: Bake) => made.name === '' ? bake.name === '' && bake.request?.scene === made.request?.scene :
        bake.name === made.name;
    const earlier = bakes.filter(bake => bake !== made && bake.created <= made.created && isSame(bake))
        .sort((a, b) => b.created - a.created);
    for (const {volume} of earlier) {
        const file = volumes.find(({id, state}) => id === volume && id !== open.id && state === 'ready');
        if (file !== undefined) return file;
    }
    return null;
}
