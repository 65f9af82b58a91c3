// SPDX-License-Identifier: Apache-2.0
// A bounding volume hierarchy over triangles: what a ray hits. Boxes are split at the median triangle of their longest
// side, so that building is fast.

const kLeaf = 4;
const kNear = 1e-4;  // metres; what is nearer to the end of a way does not block it

export interface Hit {
    distance: number;
    /** On the side from which the corners of the triangle are clockwise; never if both sides are front faces. */
    isBack: boolean;
}

export class TriangleTree {
    private readonly order: Uint32Array;
    private readonly boxes: number[] = [];     // six numbers a node: low, high
    private readonly children: number[] = [];  // two numbers a node: first child and −1, or first triangle and count

    /** Nine numbers a triangle; `isTwoSided` has one. */
    constructor(private readonly corners: Float32Array, private readonly isTwoSided: ArrayLike<number> = []) {
        const count = corners.length / 9;
        this.order = Uint32Array.from({length: count}, (_, i) => i);
        const middles = new Float32Array(3 * count);
        for (let i = 0; i < count; ++i) {
            for (let a = 0; a < 3; ++a) middles[3 * i + a] = corners[9 * i + a] + corners[9 * i + 3 + a] + corners[9 * i + 6 + a];
        }
        if (count > 0) this.build(middles);
    }

    get triangleCount(): number {
        return this.order.length;
    }

    /** The nearest triangle along a ray of unit direction, up to a distance. */
    nearest(o: ArrayLike<number>, d: ArrayLike<number>, most = Infinity): Hit | null {
        const hit: Hit = {distance: most, isBack: false};
        return this.walk(o, d, hit, false) ? hit : null;
    }

    /** Whether nothing is between two places. */
    isFree(a: ArrayLike<number>, b: ArrayLike<number>): boolean {
        const way = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
        const length = Math.hypot(...way);
        if (length < 2 * kNear) return true;
        const d = way.map(x => x / length);
        return !this.walk(a, d, {distance: length - kNear, isBack: false}, true);
    }

    private build(middles: Float32Array): void {
        const work = [[this.add(), 0, this.order.length]];
        while (work.length > 0) {
            const [node, first, count] = work.pop()!;
            this.bound(node, first, count);
            this.children[2 * node] = first;
            this.children[2 * node + 1] = count;
            if (count <= kLeaf) continue;
            const part = this.order.subarray(first, first + count);
            const axis = longestAxis(part, middles);
            const half = count >> 1;
            select(part, half, middles, axis);
            const left = this.add();
            this.add();
            this.children[2 * node] = left;
            this.children[2 * node + 1] = -1;
            work.push([left, first, half], [left + 1, first + half, count - half]);
        }
    }

    private add(): number {
        this.boxes.push(Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity);
        return this.children.push(0, 0) / 2 - 1;
    }

    private bound(node: number, first: number, count: number): void {
        for (let i = first; i < first + count; ++i) {
            for (let k = 0; k < 9; ++k) {
                const x = this.corners[9 * this.order[i] + k];
                const low = 6 * node + k % 3;
                if (x < this.boxes[low]) this.boxes[low] = x;
                if (x > this.boxes[low + 3]) this.boxes[low + 3] = x;
            }
        }
    }

    /** Shortens `hit` to the nearest triangle; with `isAny` it ends at the first. */
    private walk(o: ArrayLike<number>, d: ArrayLike<number>, hit: Hit, isAny: boolean): boolean {
        if (this.order.length === 0) return false;
        const inverse = [1 / d[0], 1 / d[1], 1 / d[2]];
        const stack = [0];
        let found = false;
        while (stack.length > 0) {
            const node = stack.pop()!;
            if (!this.isCrossed(node, o, inverse, hit.distance)) continue;
            const [child, count] = [this.children[2 * node], this.children[2 * node + 1]];
            if (count < 0) {
                stack.push(child, child + 1);
                continue;
            }
            for (let i = child; i < child + count; ++i) {
                if (!this.hits(this.order[i], o, d, hit)) continue;
                found = true;
                if (isAny) return true;
            }
        }
        return found;
    }

    private isCrossed(node: number, o: ArrayLike<number>, inverse: number[], most: number): boolean {
        let [near, far] = [0, most];
        for (let a = 0; a < 3; ++a) {
            let t0 = (this.boxes[6 * node + a] - o[a]) * inverse[a];
            let t1 = (this.boxes[6 * node + 3 + a] - o[a]) * inverse[a];
            if (t0 > t1) [t0, t1] = [t1, t0];
            if (t0 > near) near = t0;
            if (t1 < far) far = t1;
        }
        return near <= far;
    }

    /** Möller and Trumbore 1997. */
    private hits(triangle: number, o: ArrayLike<number>, d: ArrayLike<number>, hit: Hit): boolean {
        const c = this.corners;
        const at = 9 * triangle;
        const [ax, ay, az] = [c[at], c[at + 1], c[at + 2]];
        const [ux, uy, uz] = [c[at + 3] - ax, c[at + 4] - ay, c[at + 5] - az];
        const [vx, vy, vz] = [c[at + 6] - ax, c[at + 7] - ay, c[at + 8] - az];
        const [px, py, pz] = [d[1] * vz - d[2] * vy, d[2] * vx - d[0] * vz, d[0] * vy - d[1] * vx];
        const determinant = ux * px + uy * py + uz * pz;
        if (determinant === 0) return false;
        const [tx, ty, tz] = [o[0] - ax, o[1] - ay, o[2] - az];
        const u = (tx * px + ty * py + tz * pz) / determinant;
        if (u < 0 || u > 1) return false;
        const [qx, qy, qz] = [ty * uz - tz * uy, tz * ux - tx * uz, tx * uy - ty * ux];
        const v = (d[0] * qx + d[1] * qy + d[2] * qz) / determinant;
        if (v < 0 || u + v > 1) return false;
        const distance = (vx * qx + vy * qy + vz * qz) / determinant;
        if (!(distance >= 0 && distance < hit.distance)) return false;
        hit.distance = distance;
        hit.isBack = determinant < 0 && !this.isTwoSided[triangle];
        return true;
    }
}

function longestAxis(part: Uint32Array, middles: Float32Array): number {
    const sides = [0, 1, 2].map(axis => {
        let [low, high] = [Infinity, -Infinity];
        for (const i of part) {
            const x = middles[3 * i + axis];
            if (x < low) low = x;
            if (x > high) high = x;
        }
        return high - low;
    });
    return sides.indexOf(Math.max(...sides));
}

/** Puts the k smallest along an axis first (Hoare's selection). */
function select(part: Uint32Array, k: number, middles: Float32Array, axis: number): void {
    let [low, high] = [0, part.length - 1];
    while (low < high) {
        const pivot = middles[3 * part[(low + high) >> 1] + axis];
        let [i, j] = [low, high];
        while (i <= j) {
            while (middles[3 * part[i] + axis] < pivot) ++i;
            while (middles[3 * part[j] + axis] > pivot) --j;
            if (i > j) break;
            [part[i], part[j]] = [part[j], part[i]];
            ++i;
            --j;
        }
        if (k <= j) high = j;
        else if (k >= i) low = i;
        else return;
    }
}
