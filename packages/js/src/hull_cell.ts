// SPDX-License-Identifier: Apache-2.0
// Weights of positions outside the hull: of the one triangle (p_i + t ray_i), t ≥ 0, whose plane contains the position
// (Cupisz, GDC 2012).
import {crossingAfterRise, firstCrossing} from './cubic.js';

/** Rounding of the square of an area whose edges have length 1. */
const kFlatTriangle = 1e-24;

/** What a hull cell computes with. */
export class HullCell {
    /** Edges A, B from corner 2, the way D to the position; the rates of A and B; ray 2. */
    private readonly m = new Float64Array(18);

    /**
     * Sets `weights` to those of a position in the triangle whose corners relative to it are the 9 numbers of `corners`,
     * with the rays from `ray` on. False if it is behind the triangle.
     */
    weighTriangle(corners: Float64Array, rays: Float32Array, ray: number, weights: Float64Array): boolean {
        const third = nearestCorner(corners);
        const first = (third + 1) % 3;
        const second = (third + 2) % 3;
        if (!this.scaleTriangle(corners, first, second, third)) return false;
        const {m} = this;
        for (let i = 0; i < 3; ++i) {
            const last = rays[ray + 3 * third + i];
            m[9 + i] = rays[ray + 3 * first + i] - last;
            m[12 + i] = rays[ray + 3 * second + i] - last;
            m[15 + i] = last;
        }
        if (!this.weighMoving(weights)) return false;
        const w0 = weights[0], w1 = weights[1], w2 = weights[2];
        weights[first] = w0;
        weights[second] = w1;
        weights[third] = w2;
        weights[3] = 0;
        return true;
    }

    /** Differences to the corner that is nearest to the position, which keep digits, in units of the longest. */
    private scaleTriangle(corners: Float64Array, first: number, second: number, third: number): boolean {
        const {m} = this;
        for (let i = 0; i < 3; ++i) {
            const last = corners[3 * third + i];
            m[i] = corners[3 * first + i] - last;
            m[3 + i] = corners[3 * second + i] - last;
            m[6 + i] = -last;
        }
        let square = 0;
        for (let i = 0; i < 9; i += 3) square = Math.max(square, m[i] * m[i] + m[i + 1] * m[i + 1] + m[i + 2] * m[i + 2]);
        if (!(square > 0) || square === Infinity) return false;
        const unit = 1 / Math.sqrt(square);
        for (let i = 0; i < 9; ++i) m[i] *= unit;
        return true;
    }

    private weighMoving(weights: Float64Array): boolean {
        const {m} = this;
        const ax = m[0], ay = m[1], az = m[2], bx = m[3], by = m[4], bz = m[5];
        const dx = m[6], dy = m[7], dz = m[8], px = m[9], py = m[10], pz = m[11];
        const qx = m[12], qy = m[13], qz = m[14], rx = m[15], ry = m[16], rz = m[17];
        // The normal of the moved triangle: n0 + n1 t + n2 t².
        const n0x = ay * bz - az * by, n0y = az * bx - ax * bz, n0z = ax * by - ay * bx;
        const n1x = ay * qz - az * qy + (py * bz - pz * by);
        const n1y = az * qx - ax * qz + (pz * bx - px * bz);
        const n1z = ax * qy - ay * qx + (px * by - py * bx);
        const n2x = py * qz - pz * qy, n2y = pz * qx - px * qz, n2z = px * qy - py * qx;
        const c0 = n0x * dx + n0y * dy + n0z * dz;
        const c1 = n1x * dx + n1y * dy + n1z * dz - (n0x * rx + n0y * ry + n0z * rz);
        const c2 = n2x * dx + n2y * dy + n2z * dz - (n1x * rx + n1y * ry + n1z * rz);
        const c3 = -(n2x * rx + n2y * ry + n2z * rz);
        let t = firstCrossing(c0, c1, c2, c3);
        if (t === 0) {
            if (this.weighAt(0, weights)) return true;
            t = crossingAfterRise(c0, c1, c2, c3);  // the corners are collinear
        }
        return t >= 0 && this.weighAt(t, weights);
    }

    private weighAt(t: number, weights: Float64Array): boolean {
        const {m} = this;
        const fx = m[0] + t * m[9], fy = m[1] + t * m[10], fz = m[2] + t * m[11];
        const gx = m[3] + t * m[12], gy = m[4] + t * m[13], gz = m[5] + t * m[14];
        const hx = m[6] - t * m[15], hy = m[7] - t * m[16], hz = m[8] - t * m[17];
        const nx = fy * gz - fz * gy, ny = fz * gx - fx * gz, nz = fx * gy - fy * gx;
        const area = nx * nx + ny * ny + nz * nz;
        const longest = Math.max(fx * fx + fy * fy + fz * fz, gx * gx + gy * gy + gz * gz);
        if (!(area > kFlatTriangle * longest * longest)) return false;
        weights[0] = ((hy * gz - hz * gy) * nx + (hz * gx - hx * gz) * ny + (hx * gy - hy * gx) * nz) / area;
        weights[1] = ((fy * hz - fz * hy) * nx + (fz * hx - fx * hz) * ny + (fx * hy - fy * hx) * nz) / area;
        weights[2] = 1 - weights[0] - weights[1];
        return true;
    }
}

function nearestCorner(corners: Float64Array): number {
    let nearest = 2;
    let least = Infinity;
    for (let i = 0; i < 3; ++i) {
        const x = corners[3 * i], y = corners[3 * i + 1], z = corners[3 * i + 2];
        const square = x * x + y * y + z * z;
        if (!(square < least)) continue;
        least = square;
        nearest = i;
    }
    return nearest;
}

type Vec3 = readonly [number, number, number];
const vec = (a: ArrayLike<number>, at: number): Vec3 => [a[at], a[at + 1], a[at + 2]];
const dot = (a: Vec3, b: Vec3) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const scaled = (a: Vec3, s: number): Vec3 => [a[0] * s, a[1] * s, a[2] * s];
const moved = (a: Vec3, t: number, b: Vec3): Vec3 => [a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]];
const cross = (a: Vec3, b: Vec3): Vec3 =>
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const determinant = (a: Vec3, b: Vec3, c: Vec3) => dot(cross(a, b), c);

/** The same for an edge of the hull of a plane with this unit normal, seen along it. */
export function weighEdge(corners: Float64Array, rays: Float32Array, ray: number, axis: Float64Array,
                          weights: Float64Array): boolean {
    const [p, q] = [vec(corners, 0), vec(corners, 3)];
    const scale = Math.sqrt(Math.max(dot(p, p), dot(q, q)));
    if (!(scale > 0) || scale === Infinity) return false;
    const [a, b] = [scaled(p, 1 / scale), scaled(q, 1 / scale)];
    const [u, v, normal] = [vec(rays, ray), vec(rays, ray + 3), vec(axis, 0)];
    const t = firstCrossing(-determinant(a, b, normal), -determinant(u, b, normal) - determinant(a, v, normal),
                            -determinant(u, v, normal), 0);
    if (t < 0) return false;
    const start = moved(a, t, u);
    const edge = moved(moved(b, t, v), -1, start);
    const across = cross(normal, cross(edge, normal));  // the edge, seen along the normal
    const length = dot(across, edge);
    if (!(length > 0)) return false;
    const weight = -dot(across, start) / length;
    weights.set([1 - weight, weight, 0, 0]);
    return true;
}
