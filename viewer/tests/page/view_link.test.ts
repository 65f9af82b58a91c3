// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {fromLink, toLink, ViewState} from '../../src/page/view_link';

test('a link gives back the view', () => {
    const state: ViewState = {
        volume: 'a b&c=d', scene: 'höf', reflections: 'rooms', tab: 'inspect', eye: [1.5, -2, 3], target: [0, 0, 0], object: [1, 2, 3],
        exposure: 2, hidden: ['probes', 'scene'], shown: ['cells'], color: 'error', compare: 'difference', left: 'none', right: 'open',
        split: 0.25, unit: 'percent', range: 50, weights: {sun: 0, 'light:lamp 1,2': 1.5},
    };
    expect(fromLink(toLink(state))).toEqual(state);
});

test('what cannot be read is left out', () => {
    expect(fromLink('#eye=1,2&target=a,b,c&exposure=-1&w.sun=x&w.sky=-1&split=2&range=0&volume=v')).toEqual({volume: 'v'});
    expect(fromLink('#eye=1e99,0,0&object=0,1e30,0&exposure=1e300&stops=999&w.sky=1e30&volume=v')).toEqual({volume: 'v'});
    expect(fromLink('#exposure=1e-30&target=0,NaN,0&stops=x&volume=v')).toEqual({volume: 'v'});
    expect(fromLink('')).toEqual({});
});
