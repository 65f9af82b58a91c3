// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {snap, snapPosition, Snapping} from '../../src/view/snapping';

test('numbers come to multiples of the step, without noise', () => {
    expect(snap(0.31, 0.1)).toBe(0.3);
    expect(snap(-0.1, 0.25)).toBe(0);
    expect(Object.is(snap(-0.1, 0.25), 0)).toBe(true);
    expect(snap(0.31, 0)).toBe(0.31);
});

test('only the axes along which something moves are snapped', () => {
    expect(snapPosition([0.1, 0.2, 0.3], [0.9, 0.2, 0.3], 0.25)).toEqual([1, 0.2, 0.3]);
});

test('snapping is off by its switch and while Ctrl is held', () => {
    const snapping = new Snapping();
    expect([snapping.step, snapping.angle]).toEqual([0.25, 15]);
    snapping.isHeldOff = true;
    expect([snapping.step, snapping.angle]).toEqual([0, 0]);
    snapping.isHeldOff = false;
    snapping.isOn = false;
    expect([snapping.step, snapping.angle]).toEqual([0, 0]);
});
