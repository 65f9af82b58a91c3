// SPDX-License-Identifier: Apache-2.0
// Boxes as translucent shapes with outlines; the selected one has handles on its sides.
import * as three from 'three';

import {kBoxKinds} from './box_kinds';
import {Box, middleOf, sideAt, sidesOf, worldFromUnit} from './boxes';

const kFaces = {
    box: new three.BoxGeometry(1, 1, 1),
    sphere: new three.SphereGeometry(0.5, 32, 16),
    rectangle: new three.PlaneGeometry(1, 1),
};

const kOutlines = {
    box: new three.EdgesGeometry(kFaces.box),
    sphere: circles(),
    rectangle: new three.EdgesGeometry(kFaces.rectangle),
};

/** One around each axis. */
function circles(): three.BufferGeometry {
    const kCount = 48;
    const points: number[] = [];
    for (let axis = 0; axis < 3; ++axis) {
        for (let i = 0; i < 2 * kCount; ++i) {
            const angle = 2 * Math.PI * Math.ceil(i / 2) / kCount;
            const at = [0, 0.5 * Math.cos(angle), 0.5 * Math.sin(angle)];
            points.push(at[(3 - axis) % 3], at[(4 - axis) % 3], at[(5 - axis) % 3]);
        }
    }
    return new three.BufferGeometry().setAttribute('position', new three.Float32BufferAttribute(points, 3));
}

/** Sides that lie on walls are not seen, instead of flickering with them. */
const kBehindWalls = {polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 16};
const kFlat = {transparent: true, depthWrite: false, toneMapped: false} as const;

/** Corners of the outline, in pairs, in the world. */
export function outlineOf(box: Box): three.Vector3[] {
    const ends = kOutlines[box.shape].getAttribute('position');
    const world = worldFromUnit(box);
    return Array.from({length: ends.count}, (_, i) => new three.Vector3().fromBufferAttribute(ends, i).applyMatrix4(world));
}

/** Points of the same size on the screen at any distance, seen through walls. */
function makePoints(places: readonly three.Vector3[], color: number, size: number): three.Points {
    const material = new three.PointsMaterial({...kFlat, color, size, sizeAttenuation: false, depthTest: false});
    const points = new three.Points(new three.BufferGeometry().setFromPoints([...places]), material);
    points.renderOrder = 9;
    points.frustumCulled = false;
    return points;
}

function makeLines(box: Box, opacity: number, depthTest: boolean): three.LineSegments {
    const {color} = kBoxKinds[box.kind];
    return new three.LineSegments(kOutlines[box.shape], new three.LineBasicMaterial({...kFlat, color, opacity, depthTest}));
}

/** Only boxes of the kind that is edited have points to click. */
function shapeOf(box: Box, isSelected: boolean, isEdited: boolean): three.Group {
    const {color} = kBoxKinds[box.kind];
    const opacity = isSelected ? 0.28 : isEdited ? 0.14 : 0.05;
    const faces = new three.Mesh(kFaces[box.shape],
                                 new three.MeshBasicMaterial({...kFlat, color, opacity, side: three.DoubleSide, ...kBehindWalls}));
    const parts = [faces, makeLines(box, isEdited ? 1 : 0.5, true), makeLines(box, isSelected ? 0.7 : 0.35, false)];
    for (const part of parts) {
        part.matrixAutoUpdate = false;
        part.matrix.copy(worldFromUnit(box));
    }
    const group = new three.Group().add(...parts);
    if (isEdited) group.add(makePoints([pointOf(box)], isSelected ? 0xffffff : color, 10));
    if (isSelected && box.kind === 'reflections') {  // from its capture to the middle of its box
        const ends = [new three.Vector3(...box.position), new three.Vector3(...middleOf(box))];
        group.add(new three.LineSegments(new three.BufferGeometry().setFromPoints(ends),
                                         new three.LineBasicMaterial({...kFlat, color, depthTest: false})));
    }
    return group;
}

/** Where a box is clicked. */
export const pointOf = (box: Box) => new three.Vector3(...box.position);

export class BoxShapes {
    readonly root = new three.Group();

    /** `selected` is one of `boxes`, or −1. */
    show(boxes: readonly Box[], kind: string, selected: number, hasHandles: boolean): void {
        this.clear();
        boxes.forEach((box, i) => this.root.add(shapeOf(box, i === selected, box.kind === kind)));
        const box = boxes[selected];
        if (box === undefined || !hasHandles) return;
        this.root.add(makePoints(sidesOf(box).map(side => sideAt(box, side)), 0xffd24a, 13));
    }

    private clear(): void {
        this.root.traverse(object => {
            const {geometry, material} = object as Partial<three.Mesh>;
            if (object instanceof three.Points) geometry!.dispose();
            (material as three.Material | undefined)?.dispose();
        });
        this.root.clear();
    }
}
