// SPDX-License-Identifier: Apache-2.0
import * as three from 'three';
import {expect, test} from 'vitest';

import {viewAfterKey} from '../../src/view/camera_keys';

const target = new three.Vector3(1, 2, 3);
const camera = new three.PerspectiveCamera();
camera.position.set(1, 2, 13);  // ten behind the target
camera.lookAt(target);
camera.updateMatrix();

const after = (key: string, keys: Partial<KeyboardEvent> = {}) => viewAfterKey({key, ...keys} as KeyboardEvent, camera, target);
const vector = (numbers: number[]) => new three.Vector3().fromArray(numbers);

test('arrows rotate about the target at the same distance', () => {
    for (const key of ['ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown']) {
        const view = after(key)!;
        expect(vector(view.target).distanceTo(target)).toBe(0);
        expect(vector(view.eye).distanceTo(target)).toBeCloseTo(10, 6);
        expect(vector(view.eye).sub(target).angleTo(camera.position.clone().sub(target))).toBeCloseTo(0.1, 6);
    }
    expect(after('ArrowRight')!.eye[0]).toBeGreaterThan(1);
    expect(after('ArrowUp')!.eye[1]).toBeGreaterThan(2);
});

test('arrows with Shift move camera and target alike', () => {
    const {eye, target: to} = after('ArrowRight', {shiftKey: true})!;
    expect(vector(to).sub(target).distanceTo(new three.Vector3(0.5, 0, 0))).toBeLessThan(1e-6);
    expect(vector(eye).sub(camera.position).distanceTo(new three.Vector3(0.5, 0, 0))).toBeLessThan(1e-6);
});

test('plus and minus zoom, and other keys are not for the camera', () => {
    expect(vector(after('+')!.eye).distanceTo(target)).toBeCloseTo(9, 6);
    expect(vector(after('-')!.eye).distanceTo(target)).toBeCloseTo(10 / 0.9, 6);
    expect(after('w')).toBeNull();
    expect(after('ArrowUp', {altKey: true})).toBeNull();
});
