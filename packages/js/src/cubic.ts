// SPDX-License-Identifier: Apache-2.0
// Roots of c0 + c1 t + c2 t² + c3 t³ that say when the moving triangle of a hull cell reaches a position. Lengths are of
// order 1.

/** A triangle that reaches the position later belongs to another cell. */
const kFarthestRoot = 2 ** 20;

/** More than rounding makes of such a cubic. */
const kRisen = 1e-12;

/** The first t ≥ 0 where the cubic is zero; −1 if there is none, or if it is negative from the beginning. */
export function firstCrossing(c0: number, c1: number, c2: number, c3: number): number {
    if (c0 > 0) return firstRoot(c0, c1, c2, c3);
    return c0 === 0 ? 0 : crossingAfterRise(c0, c1, c2, c3);
}

/**
 * Where a cubic that is not positive at 0 falls to zero after it has risen above it, or −1. A hull triangle that is
 * thinner than steps of its float positions may face inwards, or have no area, and turn outwards as it grows.
 */
export function crossingAfterRise(c0: number, c1: number, c2: number, c3: number): number {
    const top = extrema(c1, c2, c3)[1];
    const value = (t: number) => ((c3 * t + c2) * t + c1) * t + c0;
    if (!(value(top) > kRisen)) return -1;
    let high = Math.max(1, 2 * top);
    while (high <= kFarthestRoot && value(high) > 0) high *= 2;
    return high <= kFarthestRoot ? bracketedRoot(c0, c1, c2, c3, top, high) : -1;
}

/** The t > 0 where the slope is zero, ascending; unused places are 0. */
function extrema(c1: number, c2: number, c3: number): [number, number] {
    const a = 3 * c3;
    const b = 2 * c2;
    const discriminant = b * b - 4 * a * c1;
    if (discriminant < 0) return [0, 0];
    const root = Math.sqrt(discriminant);
    const q = -0.5 * (b + (b < 0 || Object.is(b, -0) ? -root : root));
    const positive = (t: number) => Number.isFinite(t) && t > 0 ? t : 0;
    const [first, second] = [positive(q / a), positive(c1 / q)];
    return first <= second ? [first, second] : [second, first];
}

/** Smallest t > 0 where a cubic that is positive at 0 is no longer positive; −1 if there is none. */
function firstRoot(c0: number, c1: number, c2: number, c3: number): number {
    if (c1 < 0 && c2 <= 0 && c3 <= 0) {
        const root = rootOfFalling(c0, c1, c2, c3);
        return root <= kFarthestRoot ? root : -1;
    }
    const value = (t: number) => ((c3 * t + c2) * t + c1) * t + c0;
    let low = 0;
    for (const extremum of extrema(c1, c2, c3)) {
        if (extremum <= low) continue;
        if (value(extremum) <= 0) return bracketedRoot(c0, c1, c2, c3, low, extremum);
        low = extremum;
    }
    for (let high = Math.max(1, 2 * low); high <= kFarthestRoot; high *= 2) {
        if (value(high) <= 0) return bracketedRoot(c0, c1, c2, c3, low, high);
    }
    return -1;
}

/**
 * The root of a cubic that falls ever faster. It lies before that of its first three terms, from where Newton's steps
 * come down to it.
 */
function rootOfFalling(c0: number, c1: number, c2: number, c3: number): number {
    let t = 2 * c0 / (Math.sqrt(c1 * c1 - 4 * c2 * c0) - c1);
    for (let step = 0; step < 100; ++step) {
        const value = ((c3 * t + c2) * t + c1) * t + c0;
        const next = t - value / ((3 * c3 * t + 2 * c2) * t + c1);
        if (!(next < t * (1 - 1e-8))) return next;
        t = next;
    }
    return t;
}

/** The root between `low` and `high`, where the cubic is positive and not positive: Newton's steps, or halving. */
function bracketedRoot(c0: number, c1: number, c2: number, c3: number, low: number, high: number): number {
    let t = 0.5 * (low + high);
    for (let step = 0; step < 100; ++step) {
        const value = ((c3 * t + c2) * t + c1) * t + c0;
        if (value > 0) low = t;
        else high = t;
        const newton = t - value / ((3 * c3 * t + 2 * c2) * t + c1);
        const next = newton > low && newton < high ? newton : 0.5 * (low + high);
        if (Math.abs(next - t) <= 1e-15 * high) return next;
        t = next;
    }
    return t;
}
