// SPDX-License-Identifier: Apache-2.0
// How far a bake is, in words.
import type {Bake} from './api';
import {formatCount, formatPercent, formatSeconds} from './colors';

/** What bakes of each kind count. */
const kUnits: Record<Bake['kind'], string> = {
    volumes: 'probes', lightmaps: 'texels', reflections: 'rows of texels',
};

export function countsOf(bake: Bake): {done: number; count: number} {
    const {probes_done, probe_count, texels_done, texel_count, rows_done, row_count} = bake;
    return {done: probes_done ?? texels_done ?? rows_done ?? 0, count: probe_count ?? texel_count ?? row_count ?? 0};
}

/** "120 of 255 probes, 100 at the target error (39 %), 1.4 million rays/s, 3 s left". */
export function progressOf(bake: Bake): string {
    const {done, count} = countsOf(bake);
    if (count === 0) return bake.state === 'queued' ? 'queued' : 'preparing';
    const words = [`${formatCount(done)} of ${formatCount(count)} ${kUnits[bake.kind]}`];
    if (typeof bake.at_target === 'number') {
        words.push(`${formatCount(bake.at_target)} at the target error (${formatPercent(bake.share_at_target!)})`);
    }
    if (typeof bake.rays_per_second === 'number') words.push(formatRate(bake.rays_per_second));
    if (typeof bake.seconds_left === 'number') words.push(`${formatSeconds(bake.seconds_left)} left`);
    return words.join(', ');
}

export function formatRate(raysPerSecond: number): string {
    return `${(raysPerSecond / 1e6).toFixed(1)} million rays/s`;
}
