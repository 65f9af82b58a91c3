// SPDX-License-Identifier: Apache-2.0
// Where light comes through walls: places of `POST /v1/check-leaks`, in portions that the page shows as they come.
import type {Api, Bake} from '../page/api';
import type {OpenApi} from '../page/open_api';

export interface LeakPlace {
    position: number[];
    is_unseen: boolean;
    through_walls: number;
    missing: number;
    answer: number;
    traced: number;
}

interface Report {
    all_places: LeakPlace[];
    warnings?: string[];
}

export interface LeakOrder {
    scene: string;
    volume: string;
    /** Of the volume; it says which sky and sun it had. */
    bake: Bake | null;
    places: number;
}

const kPortion = 125;  // places
const kSamples = 128;
/** Of the order of a bake: how the scene is read, and light that is added to it. */
const kSceneGroups = ['Reading the scene', 'Added light'];

async function sceneMembers(api: Api): Promise<string[]> {
    const {components} = await api.get<OpenApi>('/openapi.json');
    return Object.entries(components.schemas.CheckLeaksOrder.properties!)
        .filter(([, schema]) => kSceneGroups.includes(schema['x-group'] ?? '')).map(([name]) => name);
}

/** Calls `show` with all places so far, after each portion. Returns the warnings of the command. */
export async function checkLeaks(api: Api, {scene, volume, bake, places}: LeakOrder, signal: AbortSignal,
                                 show: (places: LeakPlace[]) => void): Promise<string[]> {
    const request = bake?.request ?? {};
    const members = await sceneMembers(api);
    const light = Object.fromEntries(members.filter(name => request[name] != null).map(name => [name, request[name]]));
    const found: LeakPlace[] = [];
    const warnings = new Set<string>();
    for (let seed = 0; seed * kPortion < places; ++seed) {
        const order = {...light, scene, volume, places: Math.min(kPortion, places - seed * kPortion), samples: kSamples, seed,
                       all_places: true};
        const answer = await api.request('POST', '/v1/check-leaks', JSON.stringify(order), 'application/json', signal);
        const report = await answer.json() as Report;
        found.push(...report.all_places);
        for (const warning of report.warnings ?? []) warnings.add(warning);
        show(found);
    }
    return [...warnings];
}

export type LeakKind = 'through_walls' | 'missing' | 'error' | 'unseen';

export const kLeakKinds: Record<LeakKind, string> = {
    through_walls: 'Light through walls', missing: 'Missing light', error: 'Error against traced light',
    unseen: 'Coverage: places that see no probe',
};

/** One value for each place: light as a share of the mean traced light; for coverage, 1 or 0. */
export function leakShares(places: readonly LeakPlace[], kind: LeakKind): number[] {
    if (kind === 'unseen') return places.map(({is_unseen}) => Number(is_unseen));
    const mean = places.reduce((sum, {traced}) => sum + traced, 0) / places.length;
    const value = (place: LeakPlace) => kind === 'error' ? Math.abs(place.answer - place.traced) : place[kind];
    return places.map(place => mean > 0 ? value(place) / mean : 0);
}

/** 0 at a thousandth of the mean light and less, 1 at all of it: a step of the map is a power of ten. */
export const leakHeat = (share: number) => share <= 1e-3 ? 0 : Math.min(1, (Math.log10(share) + 3) / 3);

/** Indices of the places whose share is above a thousandth, sorted from the largest share. */
export function worstPlaces(shares: readonly number[], count: number): number[] {
    return [...shares.keys()].filter(i => leakHeat(shares[i]) > 0).sort((a, b) => shares[b] - shares[a] || a - b).slice(0, count);
}
