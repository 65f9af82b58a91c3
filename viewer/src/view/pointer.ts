// SPDX-License-Identifier: Apache-2.0
import type {Stage} from './stage';

/** What a panel does with the pointer while it is shown. */
export interface PointerUse {
    /** True: it takes this press, and the camera rests until it ends. */
    press?(x: number, y: number, event: PointerEvent): boolean;
    drag?(x: number, y: number): void;
    release?(x: number, y: number): void;
    /** A press that went nowhere. */
    click?(x: number, y: number, event: PointerEvent): void;
    double?(x: number, y: number): void;
    /** Over the view, no button down; null: it left. */
    hover?(place: {x: number; y: number} | null): void;
}

const kStill = 4;  // pixels

export class Pointer {
    use: PointerUse = {};
    private start: {x: number; y: number; isTaken: boolean} | null = null;

    constructor(stage: Stage) {
        const {canvas} = stage;
        // Before the camera's controls, which listen to the canvas too.
        stage.parent.addEventListener('pointerdown', event => {
            if (event.target !== canvas || event.button !== 0) return;
            const isTaken = this.use.press?.(event.clientX, event.clientY, event) ?? false;
            this.start = {x: event.clientX, y: event.clientY, isTaken};
            canvas.focus({preventScroll: true});  // its keys count from now on
            if (!isTaken) return;
            stage.controls.enabled = false;
            event.stopPropagation();
            canvas.setPointerCapture(event.pointerId);
        }, {capture: true});
        canvas.addEventListener('pointermove', event => {
            if (this.start?.isTaken) this.use.drag?.(event.clientX, event.clientY);
            else if (event.buttons === 0) this.use.hover?.({x: event.clientX, y: event.clientY});
        });
        canvas.addEventListener('pointerleave', () => this.use.hover?.(null));
        canvas.addEventListener('dblclick', event => this.use.double?.(event.clientX, event.clientY));
        canvas.addEventListener('pointerup', event => {
            const start = this.start;
            this.start = null;
            if (start === null) return;
            if (start.isTaken) {
                stage.controls.enabled = true;
                this.use.release?.(event.clientX, event.clientY);
            } else if (Math.hypot(event.clientX - start.x, event.clientY - start.y) < kStill) {
                this.use.click?.(event.clientX, event.clientY, event);
            }
        });
    }
}
