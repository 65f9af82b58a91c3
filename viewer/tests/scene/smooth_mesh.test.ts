// SPDX-License-Identifier: Apache-2.0
import * as three from 'three';
import {expect, test} from 'vitest';

import {isSmooth} from '../../src/scene/smooth_mesh';

test('flat faces and fine spheres are smooth, a coarse sphere is not', () => {
    expect(isSmooth(new three.BoxGeometry(1, 1, 1))).toBe(true);
    expect(isSmooth(new three.SphereGeometry(1, 48, 32))).toBe(true);
    expect(isSmooth(new three.SphereGeometry(1, 12, 8))).toBe(false);
    expect(isSmooth(new three.SphereGeometry(1, 12, 8).toNonIndexed())).toBe(false);
});

test('a mesh without normals has none that could be compared', () => {
    const bare = new three.PlaneGeometry(1, 1);
    bare.deleteAttribute('normal');
    expect(isSmooth(bare)).toBe(false);
});
