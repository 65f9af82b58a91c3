// SPDX-License-Identifier: Apache-2.0
// The pointer selects probes: one by a click, or those in a rectangle.
import {element} from '../page/dom';
import type {PointerUse} from '../view/pointer';
import type {Viewer} from '../view/viewer';
import type {GroupsEditor} from './groups_editor';

export class GroupsPointer implements PointerUse {
    private readonly frame = element('div', {class: 'frame', hidden: true});
    private start = {x: 0, y: 0};

    constructor(private readonly viewer: Viewer, private readonly editor: GroupsEditor) {
        viewer.stage.parent.append(this.frame);
    }

    press(x: number, y: number, {shiftKey}: PointerEvent): boolean {
        this.start = {x, y};
        return shiftKey && !this.viewer.gizmo.isHot;
    }

    drag(x: number, y: number): void {
        const box = this.viewer.stage.parent.getBoundingClientRect();
        const {left, top, right, bottom} = this.rectangle(x, y);
        this.frame.hidden = false;
        this.frame.style.left = `${left - box.left}px`;
        this.frame.style.top = `${top - box.top}px`;
        this.frame.style.width = `${right - left}px`;
        this.frame.style.height = `${bottom - top}px`;
    }

    release(x: number, y: number): void {
        this.frame.hidden = true;
        const {left, top, right, bottom} = this.rectangle(x, y);
        this.editor.selectBox(left, top, right, bottom);
    }

    click(x: number, y: number, {ctrlKey, metaKey}: PointerEvent): void {
        const {viewer: {gizmo}, editor} = this;
        if (gizmo.isHot || gizmo.isDragging) return;
        const ref = editor.pick(x, y);
        if (ref !== null && (ctrlKey || metaKey)) editor.toggle(ref);
        else editor.select(ref === null ? [] : [ref]);
    }

    private rectangle(x: number, y: number): {left: number; top: number; right: number; bottom: number} {
        const {start} = this;
        return {left: Math.min(x, start.x), top: Math.min(y, start.y), right: Math.max(x, start.x), bottom: Math.max(y, start.y)};
    }
}
