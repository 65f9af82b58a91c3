// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import type {Bake, StoredFile} from '../../src/page/api';
import {comparisonFromLink, linkOfComparison} from '../../src/compare/compare_link';
import {volumeBefore} from '../../src/compare/compare_sides';
import type {CompareState} from '../../src/compare/comparison';
import {factsOf} from '../../src/compare/difference_pass';

const file = (id: string, state: StoredFile['state'] = 'ready'): StoredFile => (
    {id, name: '', names: [], bytes: 1, created: 0, state});
const bake = (volume: string, name: string, created: number, scene = 's'): Bake => (
    {id: `b${volume}`, kind: 'volumes', state: 'done', name, created, volume, request: {scene}});

test('the volume before is that of the last earlier bake of the same name', () => {
    const bakes = [bake('a', 'x', 1), bake('b', 'x', 2), bake('c', 'y', 3), bake('d', 'x', 4), bake('e', 'x', 5)];
    const volumes = 'abcde'.split('').map(id => file(id));
    expect(volumeBefore(file('d'), bakes, volumes)?.id).toBe('b');
    expect(volumeBefore(file('a'), bakes, volumes)).toBe(null);
    expect(volumeBefore(file('none'), bakes, volumes)).toBe(null);
    expect(volumeBefore(file('d'), bakes, [file('a'), file('b', 'quarantined')])?.id).toBe('a');
});

test('without a name it is that of the same scene', () => {
    const bakes = [bake('a', '', 1), bake('b', '', 2, 'other'), bake('c', '', 3)];
    expect(volumeBefore(file('c'), bakes, 'abc'.split('').map(id => file(id)))?.id).toBe('a');
});

test('a bake that made the same bytes again is not before', () => {
    expect(volumeBefore(file('a'), [bake('a', 'x', 1), bake('a', 'x', 2)], [file('a')])).toBe(null);
});

test('a link gives back the comparison', () => {
    const state: CompareState = {mode: 'wipe', left: 'none', right: 'open', split: 0.25, unit: 'stops', range: 2};
    expect(comparisonFromLink(linkOfComparison(state))).toEqual(state);
    const difference: CompareState = {...state, mode: 'difference', split: 0.5, unit: 'percent', range: 50};
    expect(comparisonFromLink(linkOfComparison(difference))).toEqual(difference);
    expect(comparisonFromLink({compare: 'x', unit: 'y'}).mode).toBe('off');
});

test('facts are of the sizes of differences', () => {
    const values = Float32Array.from({length: 100}, (_, i) => (i % 2 === 0 ? 1 : -1) * (i + 1));
    expect(factsOf(values)).toEqual({mean: 50.5, p95: 95});
});
