// SPDX-License-Identifier: Apache-2.0
// How far a bake is, in words.
import type {Bake} from '../page/api';
import {counted, formatCount, formatPercent, formatSeconds} from '../page/colors';

/** What bakes of each kind count. */
const kUnits: Record<Bake['kind'], string> = {
    volumes: 'probes', lightmaps: 'texels', reflections: 'rows of texels',
};

export function countsOf(bake: Bake): {done: number; count: number} {
    const {probes_done, probe_count, texels_done, texel_count, rows_done, row_count} = bake;
    return {done: probes_done ?? texels_done ?? rows_done ?? 0, count: probe_count ?? texel_count ?? row_count ?? 0};
}

export const isUnderWay = ({state}: Bake) => state === 'queued' || state === 'running';

/** "39 %, 12 s left". */
export function shortProgressOf(bake: Bake): string {
    const {done, count} = countsOf(bake);
    if (count === 0) return bake.state === 'queued' ? 'queued' : 'preparing';
    const share = `${Math.floor(100 * Math.max(done / count, bake.share_at_target ?? 0))} %`;
    return typeof bake.seconds_left === 'number' ? `${share}, ${formatSeconds(bake.seconds_left)} left` : share;
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

/** What a finished bake says of itself. */
export function reportLine(report: Record<string, unknown>): string {
    const words: string[] = [];
    if (typeof report.probes === 'number') words.push(counted(report.probes, 'probe'));
    if (typeof report.baked === 'number') words.push(counted(report.baked, 'texel'));
    if (typeof report.pages === 'number') words.push(counted(report.pages, 'page'));
    if (typeof report.reused === 'number' && report.reused > 0) words.push(`${formatCount(report.reused)} reused`);
    if (typeof report.rays === 'number') words.push(`${formatCount(report.rays)} rays`);
    if (typeof report.rays_per_second === 'number') words.push(formatRate(report.rays_per_second));
    const error = report.standard_error as {median?: number; p99?: number} | null;
    if (error?.median !== undefined) words.push(`error ${formatPercent(error.median)} (median)`);
    for (const warning of (report.warnings ?? []) as string[]) words.push(warning.replace(/^reuse: /, ''));
    return words.join(', ');
}
