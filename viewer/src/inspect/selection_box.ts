// SPDX-License-Identifier: Apache-2.0
// Brackets at the corners of the box of what is selected, seen through walls.
import * as three from 'three';

export class SelectionBox {
    readonly lines = new three.LineSegments(
        new three.BufferGeometry(),
        new three.LineBasicMaterial({color: 0xffffff, depthTest: false, transparent: true, toneMapped: false}));

    constructor() {
        this.lines.frustumCulled = false;
        this.lines.renderOrder = 11;
        this.lines.visible = false;
    }

    show(box: three.Box3 | null): void {
        this.lines.visible = box !== null && !box.isEmpty();
        if (!this.lines.visible) return;
        this.lines.geometry.dispose();
        this.lines.geometry = new three.BufferGeometry().setFromPoints(brackets(box!));
    }
}

/** Three short lines at each corner. */
function brackets(box: three.Box3): three.Vector3[] {
    const size = box.getSize(new three.Vector3());
    const gap = Math.min(0.02 * size.length(), 0.1 * Math.min(...size.toArray()));
    const {min, max} = box.clone().expandByScalar(gap);
    const points: three.Vector3[] = [];
    for (let corner = 0; corner < 8; ++corner) {
        const isHigh = [0, 1, 2].map(axis => (corner >> axis & 1) === 1);
        const at = new three.Vector3(...isHigh.map((high, axis) => (high ? max : min).getComponent(axis)) as [number, number, number]);
        for (let axis = 0; axis < 3; ++axis) {
            const length = 0.25 * (max.getComponent(axis) - min.getComponent(axis));
            points.push(at, at.clone().setComponent(axis, at.getComponent(axis) + (isHigh[axis] ? -length : length)));
        }
    }
    return points;
}
