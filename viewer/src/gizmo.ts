// SPDX-License-Identifier: Apache-2.0
import type {Object3D} from 'three';
import {TransformControls} from 'three/addons/controls/TransformControls.js';

import type {Stage} from './stage';

/** Handles to move or scale one object; the camera rests meanwhile. */
export class Gizmo {
    isDragging = false;
    private readonly controls: TransformControls;
    private change = () => {};
    private end = () => {};

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
    }

    /** Whether the pointer is over a handle. */
    get isHot(): boolean {
        return this.controls.object !== undefined && this.controls.axis !== null;
    }

    attach(object: Object3D, mode: 'translate' | 'scale', change: () => void, end = () => {}): void {
        this.controls.setMode(mode);
        this.controls.attach(object);
        this.change = change;
        this.end = end;
        this.stage.draw();
    }

    detach(): void {
        this.controls.detach();
        this.stage.draw();
    }
}
