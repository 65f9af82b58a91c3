// SPDX-License-Identifier: Apache-2.0
import * as three from 'three';

import type {Edges} from './cell_edges';

/** The edges of cells: those of the hull in orange, as `render --wireframe` draws them. */
export class CellLines {
    readonly group = new three.Group();
    private readonly kinds: three.LineSegments[];

    constructor(innerColor = 0x6fa8ff) {
        this.kinds = [innerColor, 0xff9a3c].map(color => new three.LineSegments(
            new three.BufferGeometry(),
            new three.LineBasicMaterial({color, transparent: true, opacity: 0.35, toneMapped: false})));
        for (const lines of this.kinds) lines.frustumCulled = false;
        this.group.add(...this.kinds);
    }

    show(positions: Float32Array, edges: Edges): void {
        [edges.inner, edges.hull].forEach((ends, i) => {
            const geometry = new three.BufferGeometry();
            geometry.setAttribute('position', new three.BufferAttribute(positions, 3));
            geometry.setIndex(new three.BufferAttribute(ends, 1));
            this.kinds[i].geometry.dispose();
            this.kinds[i].geometry = geometry;
        });
    }

    clear(): void {
        this.show(new Float32Array(), {inner: new Uint32Array(), hull: new Uint32Array()});
    }
}
