// SPDX-License-Identifier: Apache-2.0

/** The mean of values, and what 95 % of them do not exceed. */
export function meanAndP95(values: ArrayLike<number>): [number, number] {
    const sorted = Float64Array.from(values).sort();
    const mean = sorted.reduce((sum, value) => sum + value, 0) / sorted.length;
    return [mean, sorted[Math.max(0, Math.ceil(0.95 * sorted.length) - 1)]];
}
