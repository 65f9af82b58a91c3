// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {ApiError, Bake, messageOf} from '../../src/page/api';
import {explain} from '../../src/bake/bake_words';

const bake = (kind: Bake['kind']) => ({id: '0123456789ab', name: 'hall', kind});
const gone = (field: string) => new ApiError(404, 'not_found', 'there is no such thing', field);

test('other errors keep the words of the service', () => {
    const refused = new ApiError(400, 'invalid', 'samples: 0 is too small', 'samples');
    expect(explain(refused, bake('volumes'))).toBe(refused);
});

test.each([['bake', /^The bake hall is not in the list .* order the bake again\.$/],
           ['scene', /^The scene of the bake hall was deleted\. Upload it again/],
           ['volume', /^The volume of the bake hall was deleted\. "Use its settings"/]])(
    'a %s that is gone is named, with a way on', (field, words) => {
        expect(messageOf(explain(gone(field), bake('volumes')))).toMatch(words);
    });

test('lightmaps are several', () => {
    expect(messageOf(explain(gone('lightmaps'), bake('lightmaps')))).toMatch(/^The lightmaps of the bake hall were deleted/);
});

test('a bake without a name is called by its id', () => {
    expect(messageOf(explain(gone('bake'), {...bake('volumes'), name: ''}))).toMatch(/^The bake 01234567 is/);
});
