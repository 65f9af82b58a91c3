// SPDX-License-Identifier: Apache-2.0
// Colours of numbers, as `render --probe-color` has them: green is good, red is not.

/** Linear colour of a badness from 0 to 1. */
export function badnessColor(badness: number): [number, number, number] {
    const x = Math.min(1, Math.max(0, badness));
    return [Math.min(1, 2 * x), Math.min(1, 2 - 2 * x) * 0.7, 0.02];
}

/** 0.1 % and less is good, 10 % and more is bad, in between by orders of magnitude. */
export function errorBadness(error: number): number {
    return error <= 0 ? 0 : (Math.log10(error) + 3) / 2;
}

export const formatPercent = (share: number) =>
    share > 0 ? `${Number((100 * share).toPrecision(2))} %` : '–';

export const formatCount = (count: number) => count.toLocaleString('en').replaceAll(',', ' ');

/** "1 probe", "1 367 tetrahedra". */
export const counted = (count: number, one: string, many = one + 's') => `${formatCount(count)} ${count === 1 ? one : many}`;

/** Fewer than four probes have none. */
export const countedTetrahedra = (count: number) => counted(count, 'tetrahedron', 'tetrahedra');

export function formatSeconds(seconds: number): string {
    if (seconds < 60) return `${Math.max(0, Math.round(seconds))} s`;
    if (seconds < 3600) return `${Math.floor(seconds / 60)} min ${Math.round(seconds % 60)} s`;
    return `${Math.floor(seconds / 3600)} h ${Math.round(seconds % 3600 / 60)} min`;
}
