// SPDX-License-Identifier: Apache-2.0
import * as three from 'three';
import {expect, test} from 'vitest';

import {keyMove} from '../../src/inspect/key_moves';

const camera = new three.PerspectiveCamera();
const moved = (key: string, more = {}) => keyMove({key, altKey: true, shiftKey: false, ...more}, camera)?.toArray().map(x => x + 0);

test('keys move along the axes that the view is nearest to', () => {
    camera.lookAt(0.3, -0.2, -1);  // towards -Z
    expect(moved('ArrowUp')).toEqual([0, 0, -0.25]);
    expect(moved('ArrowRight')).toEqual([0.25, 0, 0]);
    camera.lookAt(1, -0.2, 0.3);  // towards +X
    expect(moved('ArrowUp')).toEqual([0.25, 0, 0]);
    expect(moved('ArrowRight')).toEqual([0, 0, 0.25]);
    expect(moved('ArrowLeft', {shiftKey: true})).toEqual([0, 0, -1]);
    expect(moved('PageDown', {altKey: false})).toEqual([0, -0.25, 0]);
});

test('arrow keys without Alt are the camera’s', () => {
    expect(moved('ArrowUp', {altKey: false})).toBeUndefined();
    expect(moved('x')).toBeUndefined();
});
