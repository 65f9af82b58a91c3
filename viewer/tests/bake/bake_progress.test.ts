// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import type {Bake} from '../../src/page/api';
import {countsOf, progressOf, shortProgressOf} from '../../src/bake/bake_progress';

const bakeOf = (facts: Partial<Bake>): Bake =>
    ({id: 'a', kind: 'volumes', state: 'running', name: '', created: 0, ...facts});

test.each([
    [{kind: 'volumes', probes_done: 120, probe_count: 255}, '120 of 255 probes'],
    [{kind: 'lightmaps', texels_done: 5, texel_count: 64}, '5 of 64 texels'],
    [{kind: 'reflections', rows_done: 96, row_count: 768}, '96 of 768 rows of texels'],
] as [Partial<Bake>, string][])('each kind of bake counts what it bakes: %o', (facts, words) => {
    expect(progressOf(bakeOf(facts))).toBe(words);
});

test('the target error, the speed and the time left follow if they are known', () => {
    const facts = {probes_done: 120, probe_count: 255, at_target: 100, share_at_target: 0.39,
                   rays_per_second: 1.4e6, seconds_left: 3};
    expect(progressOf(bakeOf(facts))).toMatch(
        /^120 of 255 probes, 100 at the target error \(39 %\), 1\.4 million rays\/s, 3 s left$/);
});

test('a bake that has counted nothing is queued or preparing', () => {
    expect(countsOf(bakeOf({kind: 'reflections'}))).toEqual({done: 0, count: 0});
    expect(progressOf(bakeOf({state: 'queued'}))).toBe('queued');
    expect(progressOf(bakeOf({kind: 'reflections'}))).toBe('preparing');
});

test('the bar says the larger of the finished share and that at the target error', () => {
    const counts = {probes_done: 64, probe_count: 256};
    expect(shortProgressOf(bakeOf({state: 'queued'}))).toBe('queued');
    expect(shortProgressOf(bakeOf(counts))).toBe('25 %');
    expect(shortProgressOf(bakeOf({...counts, share_at_target: 0.5, seconds_left: 3}))).toBe('50 %, 3 s left');
    expect(shortProgressOf(bakeOf({...counts, share_at_target: null}))).toBe('25 %');
    expect(shortProgressOf(bakeOf({probes_done: 0, probe_count: 256}))).toBe('0 %');
});
