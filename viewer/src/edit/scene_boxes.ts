// SPDX-License-Identifier: Apache-2.0
// The boxes of a glTF scene: read from the extras of its nodes, and written to them.
import {Matrix4, Quaternion, Vector3} from 'three';

import type {Gltf, GltfNode} from '../scene/glb';
import {kBoxKinds, placeOf} from './box_kinds';
import {Box, BoxKindId, degreesOf, identityOf} from './boxes';
import type {Position} from './groups';

const kKinds = Object.values(kBoxKinds);

const nameOf = (node: GltfNode, index: number) => node.name || `node ${index}`;

function localOf({matrix, translation = [0, 0, 0], rotation = [0, 0, 0, 1], scale = [1, 1, 1]}: GltfNode): Matrix4 {
    if (matrix !== undefined) return new Matrix4().fromArray(matrix);
    return new Matrix4().compose(new Vector3().fromArray(translation), new Quaternion().fromArray(rotation),
                                 new Vector3().fromArray(scale));
}

/** Calls `use` for each node of the scene that is shown, with its place in the world. */
function forEachNode(gltf: Gltf, use: (node: GltfNode, index: number, world: Matrix4) => void): void {
    const visit = (index: number, parent: Matrix4) => {
        const node = gltf.nodes?.[index];
        if (node === undefined) return;
        const world = parent.clone().multiply(localOf(node));
        use(node, index, world);
        for (const child of node.children ?? []) visit(child, world);
    };
    for (const root of gltf.scenes?.[gltf.scene ?? 0]?.nodes ?? []) visit(root, new Matrix4());
}

const tidy = (x: number) => Number(x.toPrecision(7));

function boxOf(kind: BoxKindId, name: string, value: unknown, world: Matrix4): Box {
    const [position, turn, scale] = [new Vector3(), new Quaternion(), new Vector3()];
    world.decompose(position, turn, scale);
    const {shape, size, offset, settings} = kBoxKinds[kind].read(value);
    const scaled = (v: Position, factor: Vector3) => new Vector3(...v).multiply(factor).toArray().map(tidy) as unknown as Position;
    const absolute = new Vector3(Math.abs(scale.x), Math.abs(scale.y), Math.abs(scale.z));
    return {kind, name, shape, settings, rotation: degreesOf(turn), position: position.toArray().map(tidy) as unknown as Position,
            size: scaled(size, absolute), offset: scaled(offset, scale)};
}

/** `false` is none: the member of a reflection probe may be a boolean. */
const has = (node: GltfNode, extra: string) => (node.extras?.[extra] ?? false) !== false;

interface Found {
    index: number;
    box: Box;
}

function findBoxes(gltf: Gltf): Found[] {
    const found: Found[] = [];
    forEachNode(gltf, (node, index, world) => {
        for (const {id, extra} of kKinds) {
            if (has(node, extra)) found.push({index, box: boxOf(id, nameOf(node, index), node.extras![extra], world)});
        }
    });
    return found;
}

export function boxesOf(gltf: Gltf): readonly Box[] {
    return findBoxes(gltf).map(({box}) => box);
}

/** A scene whose boxes are exactly these. Nodes of boxes that did not change stay as they are. */
export function withBoxes(scene: Gltf, boxes: readonly Box[]): Gltf {
    const gltf = structuredClone(scene);
    gltf.nodes ??= [];
    gltf.scenes ??= [{}];
    const left = findBoxes(gltf);
    for (const box of boxes) {
        const at = left.findIndex(({box: {kind, name}}) => kind === box.kind && name === box.name);
        const [old] = at < 0 ? [] : left.splice(at, 1);
        if (old === undefined) append(gltf, box);
        else if (identityOf(old.box) !== identityOf(box)) rewrite(gltf, old, box);
    }
    for (const old of left) strip(gltf, old);
    return gltf;
}

function append(gltf: Gltf, box: Box): void {
    gltf.nodes!.push(nodeOf(box));
    addRoot(gltf, gltf.nodes!.length - 1);
}

function nodeOf(box: Box): GltfNode {
    const {extra, write} = kBoxKinds[box.kind];
    return {name: box.name, ...placeOf(box), extras: {[extra]: write(box)}};
}

function addRoot(gltf: Gltf, index: number): void {
    const scene = gltf.scenes![gltf.scene ?? 0];
    scene.nodes = [...scene.nodes ?? [], index];
}

function rewrite(gltf: Gltf, {index, box: old}: Found, box: Box): void {
    const isOwn = isBare(gltf, index, old.kind);
    strip(gltf, {index, box: old});
    if (!isOwn) return append(gltf, box);
    gltf.nodes![index] = nodeOf(box);
    addRoot(gltf, index);
}

/** Takes a box away, and its node out of the scene if it has no other purpose. */
function strip(gltf: Gltf, {index, box: {kind}}: Found): void {
    const node = gltf.nodes![index];
    const isOwn = isBare(gltf, index, kind);
    delete node.extras![kBoxKinds[kind].extra];
    if (Object.keys(node.extras!).length === 0) delete node.extras;
    if (!isOwn) return;
    for (const parent of [...gltf.nodes!, ...gltf.scenes!]) {
        const key = 'children' in parent ? 'children' : 'nodes';
        const list = (parent as Record<string, unknown>)[key] as number[] | undefined;
        if (!Array.isArray(list) || !list.includes(index)) continue;
        (parent as Record<string, unknown>)[key] = list.filter(child => child !== index);
        if (key === 'children' && list.length === 1) delete parent.children;  // glTF allows no empty list
    }
}

/** The node has nothing but the box, so it can be removed with it. */
function isBare(gltf: Gltf, index: number, kind: BoxKindId): boolean {
    const {extras, name: _, translation, rotation, scale, matrix, ...others} = gltf.nodes![index];
    const isMoved = gltf.animations?.some(({channels}) => channels.some(({target}) => target.node === index)) ?? false;
    const isBone = gltf.skins?.some(({joints, skeleton}) => skeleton === index || joints.includes(index)) ?? false;
    return Object.keys(others).length === 0 && Object.keys(extras ?? {}).every(key => key === kBoxKinds[kind].extra) &&
        !isMoved && !isBone;
}
