// SPDX-License-Identifier: Apache-2.0
// Probe groups as values: every edit gives new ones and leaves the old for undo.
import {kNone, VolumeData} from 'tetralight';

export type Position = readonly [number, number, number];

export interface Group {
    readonly name: string;
    readonly dering?: boolean;
    readonly rendering_layers?: readonly number[];
    readonly positions: readonly Position[];
}

export type Groups = readonly Group[];

/** A probe: which group, and which of its positions. */
export interface Ref {
    group: number;
    index: number;
}

export const keyOf = ({group, index}: Ref) => `${group}/${index}`;

interface GroupsFile {
    groups: {
        name: string; dering?: boolean; rendering_layers?: number[]; transform?: number[]; positions: number[][];
    }[];
}

/** A file of probe groups; its transforms are applied. */
export function parseGroups(text: string): Groups {
    const file = JSON.parse(text) as GroupsFile;
    return file.groups.map(({name, dering, rendering_layers, transform: m, positions}) => ({
        name,
        ...(dering === undefined ? {} : {dering}),
        ...(rendering_layers === undefined ? {} : {rendering_layers}),
        positions: positions.map(([x, y, z]): Position => m === undefined ? [x, y, z] : [
            m[0] * x + m[4] * y + m[8] * z + m[12],
            m[1] * x + m[5] * y + m[9] * z + m[13],
            m[2] * x + m[6] * y + m[10] * z + m[14],
        ]),
    }));
}

export function formatGroups(groups: Groups): string {
    return JSON.stringify({groups: groups.filter(group => group.positions.length > 0)});
}

const kAllLayers = 0xffffffff;

/** The mask that most of them are; all layers of none. */
function mostFrequent(masks: readonly number[]): number {
    const counts = new Map<number, number>();
    for (const mask of masks) counts.set(mask, (counts.get(mask) ?? 0) + 1);
    return [...counts].reduce((best, next) => next[1] > best[1] ? next : best, [kAllLayers, 0])[0];
}

function layersOf(mask: number): number[] {
    return Array.from({length: 32}, (_, layer) => layer).filter(layer => (mask >>> layer & 1) === 1);
}

/**
 * The groups that a volume was made from. Probes that were left out are not in it. A group is on the rendering layers
 * of most of its probes: others were welded to probes of other groups, or changed by adjustment volumes.
 */
export function groupsOfVolume(volume: VolumeData): Groups {
    const {groupNames, sources, exactPositions, renderingLayers} = volume;
    const lists: Position[][] = groupNames.map(() => []);
    const masks: number[][] = groupNames.map(() => []);
    for (let i = 0; i < sources.length; i += 3) {
        const [group, , probe] = sources.subarray(i, i + 3);
        if (probe === kNone) continue;
        lists[group].push([...exactPositions.subarray(3 * probe, 3 * probe + 3)] as unknown as Position);
        masks[group].push(renderingLayers[probe] ?? kAllLayers);
    }
    return groupNames.map((name, i) => {
        const mask = mostFrequent(masks[i]);
        return {name, ...(mask === kAllLayers ? {} : {rendering_layers: layersOf(mask)}), positions: lists[i]};
    });
}

export const countOf = (groups: Groups) => groups.reduce((sum, group) => sum + group.positions.length, 0);

export function allRefs(groups: Groups): Ref[] {
    return groups.flatMap(({positions}, group) => positions.map((_, index) => ({group, index})));
}

export function positionsOf(groups: Groups): Float32Array {
    return new Float32Array(groups.flatMap(group => group.positions.flatMap(p => [...p])));
}

export function add(groups: Groups, group: number, positions: readonly Position[]): Groups {
    return groups.map((g, i) => i === group ? {...g, positions: [...g.positions, ...positions]} : g);
}

function freeName(groups: Groups, name: string): string {
    const names = new Set(groups.map(group => group.name));
    let free = name;
    for (let i = 2; names.has(free); ++i) free = `${name} ${i}`;
    return free;
}

export function addGroup(groups: Groups, name: string): Groups {
    return [...groups, {name: freeName(groups, name), positions: []}];
}

/** Another name if another group has it. */
export function rename(groups: Groups, group: number, name: string): Groups {
    const others = groups.filter((_, i) => i !== group);
    return groups.map((g, i) => i === group ? {...g, name: freeName(others, name)} : g);
}

export function move(groups: Groups, refs: readonly Ref[], by: Position): Groups {
    const keys = new Set(refs.map(keyOf));
    return groups.map((g, group) => ({
        ...g,
        positions: g.positions.map((p, index): Position => keys.has(keyOf({group, index}))
            ? [p[0] + by[0], p[1] + by[1], p[2] + by[2]] : p),
    }));
}

export function remove(groups: Groups, refs: readonly Ref[]): Groups {
    const keys = new Set(refs.map(keyOf));
    return groups.map((g, group) => ({
        ...g, positions: g.positions.filter((_, index) => !keys.has(keyOf({group, index}))),
    }));
}

/** Copies beside the old ones, and where they are. */
export function duplicate(groups: Groups, refs: readonly Ref[], by: Position): [Groups, Ref[]] {
    const made: Ref[] = [];
    const copied = groups.map((g, group) => {
        const copies = refs.filter(ref => ref.group === group).map(({index}): Position => {
            const p = g.positions[index];
            return [p[0] + by[0], p[1] + by[1], p[2] + by[2]];
        });
        copies.forEach((_, i) => made.push({group, index: g.positions.length + i}));
        return {...g, positions: [...g.positions, ...copies]};
    });
    return [copied, made];
}
