// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import type {Api} from '../../src/page/api';
import {checkLeaks, LeakPlace, leakHeat, leakShares, worstPlaces} from '../../src/compare/leak_check';

const place = (through_walls: number, traced: number, is_unseen = false): LeakPlace => (
    {position: [0, 0, 0], is_unseen, through_walls, missing: 0.5, answer: traced + through_walls, traced});

test('shares are of the mean traced light', () => {
    const places = [place(1, 3), place(0, 1, true)];  // mean 2
    expect(leakShares(places, 'through_walls')).toEqual([0.5, 0]);
    expect(leakShares(places, 'missing')).toEqual([0.25, 0.25]);
    expect(leakShares(places, 'error')).toEqual([0.5, 0]);
    expect(leakShares(places, 'unseen')).toEqual([0, 1]);
    expect(leakShares([place(1, 0)], 'through_walls')).toEqual([0]);
});

test('a power of ten is a third of the map', () => {
    expect([1e-4, 1e-3, 1e-2, 0.1, 1, 10].map(share => Math.round(300 * leakHeat(share)))).toEqual([0, 0, 100, 200, 300, 300]);
});

test('the worst places come first, and those without a leak do not', () => {
    expect(worstPlaces([0.1, 0, 0.5, 1e-4, 0.5], 9)).toEqual([2, 4, 0]);
    expect(worstPlaces([0.1, 0, 0.5], 1)).toEqual([2]);
});

test('portions have seeds of their own, add up, and have the sky of the bake', async () => {
    const orders: Record<string, unknown>[] = [];
    const schema = {properties: {sky: {'x-group': 'Added light'}, sun_angle: {'x-group': 'Added light'},
                                 samples: {'x-group': 'Samples'}}};
    const get = () => Promise.resolve({components: {schemas: {CheckLeaksOrder: schema}}});
    const api = {get, request: (_: string, __: string, body: string) => {
        const order = JSON.parse(body) as {places: number; seed: number};
        orders.push(order);
        return Promise.resolve(new Response(JSON.stringify(
            {all_places: Array.from({length: order.places}, () => place(order.seed, 1)), warnings: ['w']})));
    }} as unknown as Api;
    const counts: number[] = [];
    const bake = {request: {sky: 2, samples: 9, sun_angle: null}} as never;
    const warnings = await checkLeaks(api, {scene: 's', volume: 'v', bake, places: 300}, new AbortController().signal,
                                      places => counts.push(places.length));
    expect(counts).toEqual([125, 250, 300]);
    expect(orders.map(({seed}) => seed)).toEqual([0, 1, 2]);
    expect(orders[0]).toEqual({sky: 2, scene: 's', volume: 'v', places: 125, samples: 128, seed: 0, all_places: true});
    expect(warnings).toEqual(['w']);
});
