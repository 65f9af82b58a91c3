// SPDX-License-Identifier: Apache-2.0
// Boxes of a scene as values: adjustment volumes, portals and reflection boxes. Every edit gives new ones and leaves
// the old for undo.
import {Euler, MathUtils, Matrix4, Quaternion, Vector3} from 'three';

import {snap} from '../view/snapping';
import type {Position} from './groups';

export type BoxKindId = 'adjustments' | 'portals' | 'reflections';
export type SettingValue = number | string | boolean | readonly number[];

export interface Box {
    readonly kind: BoxKindId;
    readonly name: string;
    readonly shape: 'box' | 'sphere' | 'rectangle';
    /** The middle; of a reflection box the place where its cube is captured. */
    readonly position: Position;
    /** Degrees; the turn about Y is the last, as editors do it. */
    readonly rotation: Position;
    /** Metres: sides of a box, diameters of a sphere, width and height of a rectangle and 0. */
    readonly size: Position;
    /** From the position to the middle, along the axes of the box. */
    readonly offset: Position;
    /** Those that have a value. */
    readonly settings: Readonly<Record<string, SettingValue>>;
}

/** Of each side, metres. */
export const kLeastSide = 0.01;

const tidy = (x: number) => Number(x.toFixed(6)) + 0;  // never −0
const tidied = (v: Vector3): Position => [tidy(v.x), tidy(v.y), tidy(v.z)];

export function quaternionOf({rotation}: Pick<Box, 'rotation'>): Quaternion {
    const [x, y, z] = rotation.map(MathUtils.degToRad);
    return new Quaternion().setFromEuler(new Euler(x, y, z, 'YXZ'));
}

export function degreesOf(quaternion: Quaternion): Position {
    const {x, y, z} = new Euler().setFromQuaternion(quaternion, 'YXZ');
    return tidied(new Vector3(x, y, z).multiplyScalar(MathUtils.RAD2DEG));
}

export function middleOf(box: Box): Position {
    const middle = new Vector3(...box.offset).applyQuaternion(quaternionOf(box)).add(new Vector3(...box.position));
    return tidied(middle);
}

/** From a box with sides of 1 around the origin. */
export function worldFromUnit(box: Box): Matrix4 {
    const [x, y, z] = box.size;
    return new Matrix4().compose(new Vector3(...middleOf(box)), quaternionOf(box), new Vector3(x, y, z || 1));
}

export function contains(box: Box, position: Position): boolean {
    const p = new Vector3(...position).sub(new Vector3(...middleOf(box))).applyQuaternion(quaternionOf(box).invert());
    const [x, y, z] = [p.x / box.size[0], p.y / box.size[1], p.z / box.size[2]];
    return box.shape === 'sphere' ? Math.hypot(x, y, z) <= 0.5 : Math.max(Math.abs(x), Math.abs(y), Math.abs(z)) <= 0.5;
}

/** Cubic metres. */
export function volumeOf({shape, size: [x, y, z]}: Box): number {
    return x * y * z * (shape === 'sphere' ? Math.PI / 6 : 1);
}

export function moveBy(box: Box, by: Position): Box {
    const [x, y, z] = box.position;
    return {...box, position: [tidy(x + by[0]), tidy(y + by[1]), tidy(z + by[2])]};
}

/** Sides that are at least `kLeastSide`; those of a sphere are one. */
export function resize(box: Box, size: Position): Box {
    const [x, y, z] = size.map(side => Math.max(kLeastSide, tidy(side)));
    if (box.shape === 'rectangle') return {...box, size: [x, y, 0]};
    if (box.shape === 'box') return {...box, size: [x, y, z]};
    const changed = [x, y, z].find((side, axis) => side !== box.size[axis]) ?? x;
    return {...box, size: [changed, changed, changed]};
}

/** A side of a box: which axis, and its end. */
export interface Side {
    axis: 0 | 1 | 2;
    end: -1 | 1;
}

export function sidesOf({shape}: Box): Side[] {
    const axes: (0 | 1 | 2)[] = shape === 'rectangle' ? [0, 1] : [0, 1, 2];
    return axes.flatMap(axis => [{axis, end: -1}, {axis, end: 1}] as Side[]);
}

/** Where a side's handle is, in the world. */
export function sideAt(box: Box, {axis, end}: Side): Vector3 {
    const at = new Vector3().setComponent(axis, end / 2);
    return at.applyMatrix4(worldFromUnit(box));
}

/** Outward, length 1. */
export function outwards(box: Box, {axis, end}: Side): Vector3 {
    return new Vector3().setComponent(axis, end).applyQuaternion(quaternionOf(box));
}

/** Moves a side outwards; the opposite one stays. A sphere grows around its middle. */
export function moveSide(box: Box, side: Side, by: number, step: number): Box {
    const {axis, end} = side;
    const old = box.size[axis];
    const isSphere = box.shape === 'sphere';
    const grown = Math.max(step > 0 ? step : kLeastSide, snap(old + (isSphere ? 2 : 1) * by, step));
    const size = box.size.map((length, i) => isSphere || i === axis ? tidy(grown) : length) as unknown as Position;
    if (isSphere) return {...box, size};
    const way = new Vector3().setComponent(axis, end * (grown - old) / 2);
    if (box.kind === 'reflections') {  // the place of the capture stays
        return {...box, size, offset: tidied(new Vector3(...box.offset).add(way))};
    }
    const position = new Vector3(...box.position).add(way.applyQuaternion(quaternionOf(box)));
    return {...box, size, position: tidied(position)};
}

/** A text that two boxes share if all their values are equal; the order of their settings does not matter. */
export function identityOf({kind, name, shape, position, rotation, size, offset, settings}: Box): string {
    const inOrder = Object.entries(settings).sort(([a], [b]) => a < b ? -1 : 1);
    return JSON.stringify([kind, name, shape, position, rotation, size, offset, inOrder]);
}

/** In any order. */
export function areSame(a: readonly Box[], b: readonly Box[]): boolean {
    const identities = (boxes: readonly Box[]) => boxes.map(identityOf).sort().join('\n');
    return identities(a) === identities(b);
}

/** Another name if others of its kind have it. */
export function freeName(boxes: readonly Box[], kind: BoxKindId, name: string): string {
    const names = new Set(boxes.filter(box => box.kind === kind).map(box => box.name));
    const stem = name.replace(/ \d+$/, '');
    let free = name;
    for (let i = 2; names.has(free); ++i) free = `${stem} ${i}`;
    return free;
}

export const replace = (boxes: readonly Box[], index: number, box: Box) =>
    boxes.map((other, i) => i === index ? box : other);

export const remove = (boxes: readonly Box[], index: number) => boxes.filter((_, i) => i !== index);

/** A copy beside the old one, at the end of the list. */
export function duplicate(boxes: readonly Box[], index: number): readonly Box[] {
    const box = boxes[index];
    const copy = moveBy({...box, name: freeName(boxes, box.kind, box.name)}, [box.size[0], 0, 0]);
    return [...boxes, copy];
}

export function withSetting(box: Box, key: string, value: SettingValue | undefined): Box {
    const {[key]: _, ...others} = box.settings;
    return {...box, settings: value === undefined ? others : {...others, [key]: value}};
}
