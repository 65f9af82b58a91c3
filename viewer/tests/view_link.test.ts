// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {fromLink, toLink, ViewState} from '../src/view_link';

test('a link gives back the view', () => {
    const state: ViewState = {
        volume: 'a b&c=d', scene: 'höf', reflections: 'rooms', tab: 'query', eye: [1.5, -2, 3], target: [0, 0, 0], object: [1, 2, 3],
        exposure: 2, hidden: ['cells', 'scene'], color: 'error', weights: {sun: 0, 'light:lamp 1,2': 1.5},
    };
    expect(fromLink(toLink(state))).toEqual(state);
});

test('what cannot be read is left out', () => {
    expect(fromLink('#eye=1,2&target=a,b,c&exposure=-1&w.sun=x&w.sky=-1&volume=v')).toEqual({volume: 'v'});
    expect(fromLink('')).toEqual({});
});
