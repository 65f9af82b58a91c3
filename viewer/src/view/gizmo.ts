// SPDX-License-Identifier: Apache-2.0
import {MathUtils, type Object3D} from 'three';
import {TransformControls} from 'three/addons/controls/TransformControls.js';

import type {Snapping} from './snapping';
import type {Stage} from './stage';

/** Handles to move, rotate or scale one object; the camera rests meanwhile. */
export class Gizmo {
    isDragging = false;
    private readonly controls: TransformControls;
    private change = () => {};
    private end = () => {};
    private snapping: Snapping | null = null;

    constructor(private readonly stage: Stage) {
        this.controls = new TransformControls(stage.camera, stage.canvas);
        this.controls.size = 0.8;
        stage.scene.add(this.controls.getHelper());
        this.controls.addEventListener('change', () => stage.draw());
        this.controls.addEventListener('objectChange', () => this.change());
        this.controls.addEventListener('dragging-changed', event => {
            this.isDragging = event.value as boolean;
            stage.controls.enabled = !this.isDragging;
            if (!this.isDragging) this.end();
        });
        for (const type of ['keydown', 'keyup'] as const) addEventListener(type, event => this.holdOff(event));
    }

    /** Whether the pointer is over a handle. */
    get isHot(): boolean {
        return this.controls.object !== undefined && this.controls.axis !== null;
    }

    /** Rotations snap here; who moves an object snaps its position in `change`. */
    attach(object: Object3D, mode: 'translate' | 'rotate' | 'scale', change: () => void, end = () => {},
           snapping: Snapping | null = null): void {
        this.controls.setMode(mode);
        this.controls.setSpace(mode === 'translate' ? 'world' : 'local');
        this.controls.attach(object);
        this.change = change;
        this.end = end;
        this.snapping = snapping;
        this.applySnapping();
        this.stage.draw();
    }

    detach(): void {
        this.controls.detach();
        this.stage.draw();
    }

    private holdOff(event: KeyboardEvent): void {
        if (event.key !== 'Control' || this.snapping === null) return;
        this.snapping.isHeldOff = event.type === 'keydown';
        this.applySnapping();
    }

    private applySnapping(): void {
        const angle = this.snapping?.angle ?? 0;
        this.controls.setRotationSnap(angle === 0 ? null : MathUtils.degToRad(angle));
    }
}
