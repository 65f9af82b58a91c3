// SPDX-License-Identifier: Apache-2.0
// Weights of one position in one cell (docs/how_to_query.md).
import {HullCell, weighEdge} from './hull_cell.js';
import {Dimension, VolumeData} from './volume_data.js';

/** Times the squares of three corners, relative to the position: the square of the rounding of a sum of volumes. */
const kSliverRounding = 1e-24;

/** A tetrahedron with more of the cube of the squares of its corners is neither a sliver nor far away. */
const kThick = 1e-16;

/** Beyond so many squares of its longest edge a tetrahedron is far away. */
const kFarSquare = 2 ** 20;

/** Positions farther than so many extents of the volume are moved to that distance: only their direction counts. */
const kFarthestExtents = 65536;

export class CellWeights {
    /** The local position. */
    readonly q = new Float64Array(3);
    /** Of the cell that was weighed last: not normalized, the fourth is −1 behind a hull triangle. Then the measure. */
    readonly w = new Float64Array(5);
    readonly cellCount: number;
    private readonly isInSpace: boolean;
    private readonly innerCellCount: number;
    private readonly corners = new Float64Array(12);
    private readonly hull = new HullCell();

    constructor(readonly volume: VolumeData) {
        this.cellCount = volume.cells.length / 8;
        this.isInSpace = volume.info.dimension === Dimension.Space;
        this.innerCellCount = volume.info.innerCellCount;
    }

    /** Sets `q`. False if the world position is not finite. */
    moveTo(x: number, y: number, z: number): boolean {
        const {q, volume: {info}} = this;
        q[0] = x - info.origin[0];
        q[1] = y - info.origin[1];
        q[2] = z - info.origin[2];
        if (!(Math.abs(q[0]) < Infinity && Math.abs(q[1]) < Infinity && Math.abs(q[2]) < Infinity)) return false;
        if (info.dimension === Dimension.Plane || info.dimension === Dimension.Line) this.moveToFoot();
        this.moveWithinReach();
        return true;
    }

    /** To the foot on the plane or line of the probes. */
    private moveToFoot(): void {
        const {q, volume: {info, positions}} = this;
        const {axis} = info;
        let along = 0;
        for (let i = 0; i < 3; ++i) along += axis[i] * (q[i] - positions[i]);
        for (let i = 0; i < 3; ++i) {
            q[i] = info.dimension === Dimension.Plane ? q[i] - axis[i] * along : positions[i] + axis[i] * along;
        }
    }

    private moveWithinReach(): void {
        const {q} = this;
        const far = kFarthestExtents * this.volume.info.extent;
        const square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2];
        if (!(far > 0) || !(square > far * far)) return;
        // Squares of very far positions overflow.
        const scale = square === Infinity ? far / Math.hypot(q[0], q[1], q[2]) : far / Math.sqrt(square);
        for (let i = 0; i < 3; ++i) q[i] *= scale;
    }

    /** The smallest weight over their sum: ≥ 0 if the cell contains the position, −∞ for slivers. */
    get measure(): number {
        return this.w[4];
    }

    /** Weighs the position in a cell. True if the cell contains it. */
    contains(cell: number): boolean {
        if (!this.isInSpace) this.weighFlat(cell);
        else if (cell < this.innerCellCount) this.weighTetrahedron(cell);
        else this.weighHull(cell);
        return this.w[4] >= 0;
    }

    /** Signed volumes of the position with the faces: b·(c×d), −a·(c×d), d·(a×b), −c·(a×b). */
    private weighTetrahedron(cell: number): void {
        const {w, q, volume: {positions: p, cells}} = this;
        const at = 8 * cell;
        const qx = q[0], qy = q[1], qz = q[2];
        const a = 3 * cells[at], b = 3 * cells[at + 1], c = 3 * cells[at + 2], d = 3 * cells[at + 3];
        const ax = p[a] - qx, ay = p[a + 1] - qy, az = p[a + 2] - qz;
        const bx = p[b] - qx, by = p[b + 1] - qy, bz = p[b + 2] - qz;
        const cx = p[c] - qx, cy = p[c + 1] - qy, cz = p[c + 2] - qz;
        const dx = p[d] - qx, dy = p[d + 1] - qy, dz = p[d + 2] - qz;
        const ex = cy * dz - cz * dy, ey = cz * dx - cx * dz, ez = cx * dy - cy * dx;
        const fx = ay * bz - az * by, fy = az * bx - ax * bz, fz = ax * by - ay * bx;
        const w0 = bx * ex + by * ey + bz * ez;
        const w1 = -(ax * ex + ay * ey + az * ez);
        const w2 = dx * fx + dy * fy + dz * fz;
        const w3 = -(cx * fx + cy * fy + cz * fz);
        const sum = w0 + w2 + (w1 + w3);
        const squares = ax * ax + ay * ay + az * az + (bx * bx + by * by + bz * bz) + (cx * cx + cy * cy + cz * cz) +
                        (dx * dx + dy * dy + dz * dz);
        w[0] = w0;
        w[1] = w1;
        w[2] = w2;
        w[3] = w3;
        const isThick = sum > 0 && sum * sum > kThick * squares * squares * squares;
        if (!isThick) return this.weighThin(a, b, c, d);
        const low = w0 < w1 ? w0 : w1;
        const high = w2 < w3 ? w2 : w3;
        w[4] = (low < high ? low : high) / sum;
    }

    /** The same where rounding counts: `w` has the volumes, vertices are given by their places. */
    private weighThin(a: number, b: number, c: number, d: number): void {
        const {w, q, volume: {positions: p}} = this;
        const edge = (from: number, to: number) => square(p[to] - p[from], p[to + 1] - p[from + 1], p[to + 2] - p[from + 2]);
        const away = (corner: number) => square(p[corner] - q[0], p[corner + 1] - q[1], p[corner + 2] - q[2]);
        if (away(a) > kFarSquare * Math.max(edge(a, b), edge(a, c), edge(a, d))) return this.weighFar(a, b, c, d);
        const squares = [away(a), away(b), away(c), away(d)].sort((x, y) => x - y);
        setMeasure(w, kSliverRounding * squares[1] * squares[2] * squares[3]);
    }

    /** From edges, whose digits differences to a far position lose. Only the signs are good. */
    private weighFar(a: number, b: number, c: number, d: number): void {
        const {w, q, volume: {positions: p}} = this;
        const volumeOf = (from: number, i: number, j: number) => {
            const [ix, iy, iz] = [p[i] - p[from], p[i + 1] - p[from + 1], p[i + 2] - p[from + 2]];
            const [jx, jy, jz] = [p[j] - p[from], p[j + 1] - p[from + 1], p[j + 2] - p[from + 2]];
            return (p[from] - q[0]) * (iy * jz - iz * jy) + (p[from + 1] - q[1]) * (iz * jx - ix * jz) +
                   (p[from + 2] - q[2]) * (ix * jy - iy * jx);
        };
        w[0] = volumeOf(b, c, d);
        w[1] = volumeOf(a, d, c);
        w[2] = volumeOf(a, b, d);
        w[3] = volumeOf(a, c, b);
        setMeasure(w, 0);
    }

    private weighHull(cell: number): void {
        const {w, volume: {info, hullRays}} = this;
        this.takeCorners(cell, 3);
        const isOutside = this.hull.weighTriangle(this.corners, hullRays, 9 * (cell - info.innerCellCount), w);
        if (isOutside) setMeasure(w, 0);
        else this.goInside();
    }

    /** Cells of planes, lines and points. */
    private weighFlat(cell: number): void {
        const {w, corners, volume: {info: {dimension, innerCellCount, axis}, hullRays}} = this;
        const isInner = cell < innerCellCount;
        this.takeCorners(cell, dimension - (isInner ? 0 : 1));
        const ray = 9 * (cell - innerCellCount);
        if (dimension === Dimension.Plane) {
            if (isInner) return this.weighInPlane();
            return weighEdge(corners, hullRays, ray, axis, w) ? setMeasure(w, 0) : this.goInside();
        }
        if (dimension === Dimension.Line && isInner) {
            w.set([alongAxis(corners, 3, axis), -alongAxis(corners, 0, axis), 0, 0]);
            return setMeasure(w, 0);
        }
        const isBeyond = isInner || corners[0] * hullRays[ray] + corners[1] * hullRays[ray + 1] +
                                    corners[2] * hullRays[ray + 2] <= 0;
        if (!isBeyond) return this.goInside();
        w.set([1, 0, 0, 0, 0]);
    }

    /** Twice the areas of the position with the edges, seen along the axis. */
    private weighInPlane(): void {
        const {w, corners: m, volume: {info: {axis}}} = this;
        const area = (i: number, j: number) => axis[0] * (m[i + 1] * m[j + 2] - m[i + 2] * m[j + 1]) +
                                               axis[1] * (m[i + 2] * m[j] - m[i] * m[j + 2]) +
                                               axis[2] * (m[i] * m[j + 1] - m[i + 1] * m[j]);
        w.set([area(3, 6), -area(0, 6), area(0, 3), 0]);
        const longest = Math.max(...[0, 3, 6].map(i => square(m[i], m[i + 1], m[i + 2])));
        setMeasure(w, kSliverRounding * (longest * longest));
    }

    private takeCorners(cell: number, count: number): void {
        const {corners, q, volume: {positions, cells}} = this;
        for (let i = 0; i < count; ++i) {
            const at = 3 * cells[8 * cell + i];
            for (let k = 0; k < 3; ++k) corners[3 * i + k] = positions[at + k] - q[k];
        }
    }

    private goInside(): void {
        this.w.set([0, 0, 0, -1, -Infinity]);
    }
}

const square = (x: number, y: number, z: number) => x * x + y * y + z * z;

function alongAxis(corners: Float64Array, at: number, axis: Float64Array): number {
    return corners[at] * axis[0] + corners[at + 1] * axis[1] + corners[at + 2] * axis[2];
}

function setMeasure(w: Float64Array, rounding: number): void {
    const sum = w[0] + w[2] + (w[1] + w[3]);
    const hasVolume = sum > 0 && sum * sum > rounding;
    w[4] = hasVolume ? Math.min(w[0], w[1], w[2], w[3]) / sum : -Infinity;
}
