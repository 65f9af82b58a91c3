// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {placeOf} from '../../src/light/lightmaps';

test('nodes of unwrap and of export say the same place', () => {
    const scale = [0.5, 0.25], offset = [0.125, 0.5];
    const unwrapped = {extras: {lightmap_rectangle: {page: 1, texCoord: 2, scale, offset}}};
    const exported = {extensions: {MX_lightmap: {lightMapTexture: {index: 4, texCoord: 2}, scale, offset}}};
    expect(placeOf(unwrapped, -1)).toEqual({page: 1, channel: 2, scale, offset});
    expect(placeOf(exported, 3)).toEqual(placeOf(unwrapped, -1));
    expect(placeOf({extras: {}}, 0)).toBeNull();
});
