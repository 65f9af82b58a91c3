// SPDX-License-Identifier: Apache-2.0
// What the kinds of boxes have of their own: words, settings, extras of glTF nodes, files of the command.
import {Matrix4, Quaternion, Vector3} from 'three';

import {Box, BoxKindId, quaternionOf, SettingValue} from './boxes';
import type {Position} from './groups';

/** A setting of a box, as a field of a form. */
export interface BoxSetting {
    key: string;
    label: string;
    hint: string;
    type: 'number' | 'choice' | 'layers';
    min?: number;
    max?: number;
    step?: number;
    isInteger?: boolean;
    /** What an empty field means, in words. */
    without: string;
    choices?: [value: string, label: string][];
}

export interface BoxKind {
    id: BoxKindId;
    title: string;
    one: string;
    /** "No portals yet. …" */
    purpose: string;
    /** Of new ones. */
    name: string;
    color: number;
    size: Position;
    firstSettings: Record<string, SettingValue>;
    settings: BoxSetting[];
    /** Member of a node's `extras`. */
    extra: string;
    read(value: unknown): Pick<Box, 'shape' | 'size' | 'offset' | 'settings'>;
    write(box: Box): unknown;
    /** Why a bake would refuse it; '' if it would not. */
    fault(box: Box): string;
    /** The file of an option of the command. */
    file?: {name: string; option: string; text(boxes: readonly Box[]): string};
}

type Members = Record<string, unknown>;

function settingsOf(members: Members, settings: readonly BoxSetting[]): Record<string, SettingValue> {
    const known = settings.filter(({key}) => members[key] !== undefined);
    return Object.fromEntries(known.map(({key}) => [key, members[key] as SettingValue]));
}

const kNowhere: Position = [0, 0, 0];

const kAdjustmentSettings: BoxSetting[] = [
    {key: 'forbid', label: 'Probes in it', type: 'choice', without: 'as around it',
     hint: 'The smallest volume around a place counts.', choices: [['true', 'forbidden'], ['false', 'allowed again']]},
    {key: 'spacing', label: 'Spacing, metres', type: 'number', min: 0.01, step: 0.25, without: 'that of the grid',
     hint: 'Between the probes that the generator places here.'},
    {key: 'validity', label: 'Validity, 0 to 1', type: 'number', min: 0, max: 1, step: 0.1, without: 'as measured',
     hint: '1 is free space, 0 is inside geometry.'},
    {key: 'intensity', label: 'Intensity, factor', type: 'number', min: 0, step: 0.1, without: '1',
     hint: 'On the baked light of the probes here.'},
    {key: 'rendering_layers', label: 'Rendering layers', type: 'layers', without: 'those of the groups',
     hint: 'Numbers from 0 to 31, such as 0, 3.'},
];

function adjustmentMembers(box: Box): Members {
    const {settings} = box;
    return Object.fromEntries(kAdjustmentSettings.map(({key}) => key).filter(key => settings[key] !== undefined)
        .map(key => [key, settings[key]]));
}

const isRound = ({size: [x, y, z]}: Box) => x === y && y === z;

/** A file of volumes along the axes of the world. */
function adjustmentsFile(boxes: readonly Box[]): string {
    const adjustments = boxes.map(box => {
        const {name, shape, position, size, rotation} = box;
        const isTurned = rotation.some(angle => angle !== 0);
        if (shape === 'sphere' ? !isRound(box) : isTurned) {
            throw new Error(`${name}: the file of --adjustments holds no ${shape === 'sphere' ? 'ellipsoids' : 'rotations'}. ` +
                            `Save it in the scene, or set its ${shape === 'sphere' ? 'size' : 'rotation'} back`);
        }
        const extent = shape === 'sphere' ? {radius: size[0] / 2} : {size};
        return {name, shape, center: position, ...extent, ...adjustmentMembers(box)};
    });
    return JSON.stringify({adjustments}, null, 2);
}

const kAdjustments: BoxKind = {
    id: 'adjustments', title: 'Adjustment volumes', one: 'volume', name: 'volume', color: 0xff8a5c, size: [2, 2, 2],
    purpose: 'In an adjustment volume probes are forbidden, closer together, valid, or scaled.',
    firstSettings: {forbid: true}, settings: kAdjustmentSettings, extra: 'probe_adjustment',
    read(value) {
        const members = value as Members;
        const shape = members.shape === 'sphere' ? 'sphere' : 'box';
        const diameter = 2 * (members.radius as number | undefined ?? 1);
        const size = shape === 'sphere' ? [diameter, diameter, diameter] as const : members.size as Position ?? [1, 1, 1];
        return {shape, size, offset: kNowhere, settings: settingsOf(members, kAdjustmentSettings)};
    },
    write(box) {
        const extent = box.shape === 'sphere' ? {radius: isRound(box) ? box.size[0] / 2 : 1} : {size: box.size};
        return {shape: box.shape, ...extent, ...adjustmentMembers(box)};
    },
    fault: box => Object.keys(box.settings).length > 0 ? '' : 'has no effect: set at least one value',
    file: {name: 'adjustments.json', option: '--adjustments', text: adjustmentsFile},
};

const kPortals: BoxKind = {
    id: 'portals', title: 'Portals', one: 'portal', name: 'window', color: 0x5cc8ff, size: [1.25, 1.5, 0],
    purpose: 'A portal is a window or door through which light enters. Bakes find most of them; mark those that ' +
        'they do not find.',
    firstSettings: {}, settings: [], extra: 'portal',
    read(value) {
        const [width, height] = value as [number, number];
        return {shape: 'rectangle', size: [width, height, 0], offset: kNowhere, settings: {}};
    },
    write: ({size: [width, height]}) => [width, height],
    fault: () => '',
};

const kReflectionSettings: BoxSetting[] = [
    {key: 'blend_distance', label: 'Blend distance, metres', type: 'number', min: 0, step: 0.05, without: '0.25',
     hint: 'Outside the box the reflection fades out over this distance. At most the thickness of the walls.'},
    {key: 'importance', label: 'Importance', type: 'number', step: 1, isInteger: true, without: '1',
     hint: 'Boxes of higher importance hide others.'},
    {key: 'near', label: 'Near, metres', type: 'number', min: 0, step: 0.05, without: '0',
     hint: 'Surfaces that are nearer to the capture are not in the reflection.'},
];

/** The axes of a box as columns. */
function axesOf(box: Box): Position[] {
    const turn = new Matrix4().makeRotationFromQuaternion(quaternionOf(box));
    return [0, 1, 2].map(i => new Vector3().setFromMatrixColumn(turn, i).toArray() as Position);
}

function reflectionsFile(boxes: readonly Box[]): string {
    const reflection_probes = boxes.map(box => {
        const {name, position, size, offset, rotation, settings} = box;
        const center = new Vector3(...offset).applyQuaternion(quaternionOf(box)).toArray();
        const axes = rotation.every(angle => angle === 0) ? {} : {axes: axesOf(box)};
        return {name, position, box: {center, half_size: size.map(side => side / 2), ...axes}, ...settings};
    });
    return JSON.stringify({reflection_probes}, null, 2);
}

const kReflections: BoxKind = {
    id: 'reflections', title: 'Reflection boxes', one: 'reflection box', name: 'reflection', color: 0xb58cff, size: [4, 3, 4],
    purpose: 'Objects in a reflection box mirror what is seen from its capture, projected to the sides of the box.',
    firstSettings: {}, settings: kReflectionSettings, extra: 'reflection_probe',
    read(value) {
        const members = (typeof value === 'object' ? value : {}) as Members;
        return {shape: 'box', size: members.size as Position ?? [10, 10, 10], offset: members.center as Position ?? kNowhere,
                settings: settingsOf(members, kReflectionSettings)};
    },
    write: ({size, offset, settings}) => ({size, ...offset.some(x => x !== 0) ? {center: offset} : {}, ...settings}),
    fault: () => '',
    file: {name: 'reflections.json', option: '--places', text: reflectionsFile},
};

export const kBoxKinds: Readonly<Record<BoxKindId, BoxKind>> = {
    adjustments: kAdjustments, portals: kPortals, reflections: kReflections,
};

/** A new box of a kind, at a place. */
export function makeBox(kind: BoxKindId, name: string, position: Position): Box {
    const {size, firstSettings} = kBoxKinds[kind];
    const shape = kind === 'portals' ? 'rectangle' : 'box';
    return {kind, name, shape, position, rotation: kNowhere, size, offset: kNowhere, settings: firstSettings};
}

/** Position, rotation and scale of a node that a box is written to. */
export function placeOf(box: Box): {translation: number[]; rotation?: number[]; scale?: number[]} {
    const turn = quaternionOf(box);
    const place: ReturnType<typeof placeOf> = {translation: [...box.position]};
    if (!turn.equals(new Quaternion())) place.rotation = turn.toArray();
    if (box.shape === 'sphere' && !isRound(box)) place.scale = box.size.map(side => side / 2);
    return place;
}
