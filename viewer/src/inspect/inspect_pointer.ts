// SPDX-License-Identifier: Apache-2.0
// The pointer selects what is in the scene, and drags what moves.
import * as three from 'three';

import type {SceneObject} from '../scene/scene_objects';
import {Drag} from '../view/drag';
import type {PointerUse} from '../view/pointer';
import type {Viewer} from '../view/viewer';
import {pick, Picked} from './pick';

export interface Selector {
    readonly viewer: Viewer;
    /** The ball, or null while it is not shown. */
    readonly shownBall: three.Object3D | null;
    /** Where what is selected is. */
    readonly at: three.Vector3 | null;
    selectBall(): void;
    selectObject(object: SceneObject, hit: Picked): void;
    selectProbe(probe: number): void;
    selectNothing(): void;
    moveSelected(to: three.Vector3): void;
    /** The move is over. */
    moved(): void;
    putBall(point: three.Vector3, normal: three.Vector3): void;
    pointAt(probe: number): void;
}

export class InspectPointer implements PointerUse {
    private current: Drag | null = null;

    constructor(private readonly selector: Selector) {}

    press(x: number, y: number, {altKey, shiftKey}: PointerEvent): boolean {
        const {selector, selector: {viewer: {stage, gizmo}}} = this;
        if (altKey || gizmo.isHot) return false;
        const caster = stage.rayAt(x, y);
        const hit = this.pickScene(caster);
        const ball = selector.shownBall === null ? undefined : caster.intersectObject(selector.shownBall)[0];
        if (ball !== undefined && (hit === null || ball.distance <= hit.distance)) {
            selector.selectBall();
        } else if (hit !== null && !hit.object.isStatic && this.probeAt(x, y, hit) < 0) {
            selector.selectObject(hit.object, hit);
        } else {
            return false;
        }
        this.current = new Drag(stage, selector.at!, x, y, shiftKey);
        return true;
    }

    drag(x: number, y: number): void {
        const to = this.current?.to(x, y) ?? null;
        if (to !== null) this.selector.moveSelected(to);
    }

    release(): void {
        this.current = null;
        this.selector.moved();
    }

    click(x: number, y: number, {shiftKey}: {shiftKey: boolean}): void {
        const {selector} = this;
        const hit = this.pickScene(selector.viewer.stage.rayAt(x, y));
        const probe = shiftKey ? -1 : this.probeAt(x, y, hit);
        if (probe >= 0) selector.selectProbe(probe);
        else if (hit === null) selector.selectNothing();
        else if (shiftKey && selector.viewer.volume !== null) selector.putBall(hit.point, hit.normal);
        else selector.selectObject(hit.object, hit);
    }

    double(x: number, y: number): void {
        if (this.press(x, y, {altKey: false, shiftKey: false} as PointerEvent)) this.release();
        else this.click(x, y, {shiftKey: true});
    }

    hover(place: {x: number; y: number} | null): void {
        this.selector.pointAt(place === null ? -1 : this.probeAt(place.x, place.y));
    }

    private pickScene(caster: three.Raycaster): Picked | null {
        const {model, hidden} = this.selector.viewer;
        return model === null || hidden.has('scene') ? null : pick(caster, model.objects);
    }

    /** The probe that is seen at a place of the page, or -1; `hit` is what the scene has there. */
    private probeAt(x: number, y: number, hit?: Picked | null): number {
        const {marks: {balls}, hidden, stage} = this.selector.viewer;
        if (balls === null || hidden.has('probes')) return -1;
        const caster = stage.rayAt(x, y);
        const probe = balls.pick(caster.ray);
        if (probe < 0) return -1;
        const center = new three.Vector3().fromArray(balls.positions, 3 * probe);
        const before = hit === undefined ? this.pickScene(caster) : hit;
        const isHidden = before !== null && before.distance < center.distanceTo(caster.ray.origin) - balls.radiusOf(probe);
        return isHidden ? -1 : probe;
    }
}
