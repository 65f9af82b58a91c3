// SPDX-License-Identifier: Apache-2.0
// Boxes in 3D: which is clicked, moved, rotated, or sized by the handles on its sides.
import * as three from 'three';

import type {Gizmo} from '../view/gizmo';
import {snap, snapPosition, Snapping} from '../view/snapping';
import type {Stage} from '../view/stage';
import {kBoxKinds, makeBox} from './box_kinds';
import {BoxShapes, outlineOf, pointOf} from './box_shapes';
import * as boxes from './boxes';
import {Box, BoxKindId, contains, middleOf, Side, sideAt, sidesOf, worldFromUnit} from './boxes';
import type {EditSession} from './edit_session';
import type {Position} from './groups';

export type Handles = 'move' | 'rotate' | 'size';

const kNearPoint = 14;  // pixels
const kNearLine = 7;
const kFar = 1e4;  // metres

interface Drag {
    box: Box;
    side: Side;
    start: three.Vector3;
}

export class BoxEditor {
    readonly shapes = new BoxShapes();
    private readonly pivot = new three.Object3D();
    private currentHandles: Handles = 'move';
    private preview: Box | null = null;
    private drag: Drag | null = null;
    private shown: object | null = null;

    constructor(private readonly session: EditSession, private readonly stage: Stage, private readonly gizmo: Gizmo,
                private readonly snapping: Snapping, private readonly changed: () => void) {
        this.shapes.root.visible = false;
        stage.scene.add(this.shapes.root, this.pivot);
        session.onChange(() => this.refresh());
    }

    set isActive(isActive: boolean) {
        this.shapes.root.visible = isActive;
        this.shown = null;
        this.refresh();
    }

    get handles(): Handles {
        return this.currentHandles;
    }

    set handles(handles: Handles) {
        this.currentHandles = handles;
        this.shown = null;
        this.refresh();
        this.changed();
    }

    /** As it is while a handle is dragged. */
    get selected(): Box | null {
        const {boxes: all, box, kind} = this.session.now;
        return this.preview ?? (all[box]?.kind === kind ? all[box] : null);
    }

    private get kind(): BoxKindId | null {
        const {kind} = this.session.now;
        return kind === 'groups' ? null : kind;
    }

    select(index: number): void {
        this.session.choose({box: index});
    }

    addAt(position: Position): void {
        const {kind} = this;
        if (kind === null) return;
        const all = this.session.now.boxes;
        const at = position.map(x => snap(x, this.snapping.step || 0.01)) as unknown as Position;
        const box = makeBox(kind, boxes.freeName(all, kind, kBoxKinds[kind].name), at);
        this.session.edit({boxes: [...all, box], box: all.length});
    }

    /** Another value of the selected box. */
    become(box: Box): void {
        const {boxes: all, box: index} = this.session.now;
        if (this.selected !== null) this.session.edit({boxes: boxes.replace(all, index, box)});
    }

    moveBy(by: Position): void {
        if (this.selected !== null) this.become(boxes.moveBy(this.selected, by));
    }

    duplicateSelected(): void {
        const {boxes: all, box} = this.session.now;
        if (this.selected !== null) this.session.edit({boxes: boxes.duplicate(all, box), box: all.length});
    }

    removeSelected(): void {
        const {boxes: all, box} = this.session.now;
        if (this.selected !== null) this.session.edit({boxes: boxes.remove(all, box), box: -1});
    }

    /** Starts to drag the handle under the pointer, if there is one. */
    press(x: number, y: number): boolean {
        const box = this.selected;
        if (box === null || this.handles !== 'size') return false;
        const near = sidesOf(box).map(side => ({side, pixels: this.pixelsFrom(sideAt(box, side), x, y)}))
            .sort((a, b) => a.pixels - b.pixels)[0];
        if (near.pixels > kNearPoint) return false;
        this.drag = {box, side: near.side, start: this.onLine(box, near.side, x, y)};
        return true;
    }

    dragTo(x: number, y: number): void {
        if (this.drag === null) return;
        const {box, side, start} = this.drag;
        const by = this.onLine(box, side, x, y).sub(start).dot(boxes.outwards(box, side));
        this.show(boxes.moveSide(box, side, by, this.snapping.step));
    }

    release(): void {
        this.drag = null;
        this.finish();
    }

    click(x: number, y: number): void {
        this.select(this.pick(x, y));
    }

    /** Of the kind that is edited: by its point, its outline, or its faces from outside. */
    private pick(x: number, y: number): number {
        const {boxes: all, kind} = this.session.now;
        const own = all.map((box, index) => ({box, index})).filter(({box}) => box.kind === kind);
        const best = (distance: (box: Box) => number, most: number) => own
            .map(({box, index}) => ({index, distance: distance(box)}))
            .filter(each => each.distance < most).sort((a, b) => a.distance - b.distance)[0]?.index;
        return best(box => this.pixelsFrom(pointOf(box), x, y), kNearPoint) ??
            best(box => this.pixelsFromOutline(box, x, y), kNearLine) ??
            best(box => this.metersTo(box, x, y), Infinity) ?? -1;
    }

    private pixelsFrom(place: three.Vector3, x: number, y: number): number {
        const p = this.stage.pageFrom(place);
        return p.isInFront ? Math.hypot(p.x - x, p.y - y) : Infinity;
    }

    private pixelsFromOutline(box: Box, x: number, y: number): number {
        const ends = outlineOf(box).map(end => this.stage.pageFrom(end));
        const at = new three.Vector3(x, y, 0);
        let nearest = Infinity;
        for (let i = 0; i < ends.length; i += 2) {
            const [a, b] = [ends[i], ends[i + 1]];
            if (!a.isInFront || !b.isInFront) continue;
            const line = new three.Line3(new three.Vector3(a.x, a.y), new three.Vector3(b.x, b.y));
            nearest = Math.min(nearest, line.closestPointToPoint(at, true, new three.Vector3()).distanceTo(at));
        }
        return nearest;
    }

    /** Along the ray through a place of the page; infinite where it misses, or begins inside. */
    private metersTo(box: Box, x: number, y: number): number {
        const {ray} = this.stage.rayAt(x, y);
        if (contains(box, ray.origin.toArray())) return Infinity;
        const world = worldFromUnit(box);
        const local = ray.clone().applyMatrix4(world.clone().invert());
        const flat = box.shape === 'rectangle' ? 1e-3 : 0.5;
        const hit = box.shape === 'sphere' ? local.intersectSphere(new three.Sphere(new three.Vector3(), 0.5), new three.Vector3()) :
            local.intersectBox(new three.Box3(new three.Vector3(-0.5, -0.5, -flat), new three.Vector3(0.5, 0.5, flat)),
                               new three.Vector3());
        return hit === null ? Infinity : hit.applyMatrix4(world).distanceTo(ray.origin);
    }

    /** The place on the line through the middle of a side that is nearest to the pointer. */
    private onLine(box: Box, side: Side, x: number, y: number): three.Vector3 {
        const middle = new three.Vector3(...middleOf(box));
        const way = boxes.outwards(box, side).multiplyScalar(kFar);
        const found = new three.Vector3();
        this.stage.rayAt(x, y).ray.distanceSqToSegment(middle.clone().sub(way), middle.add(way), undefined, found);
        return found;
    }

    private refresh(): void {
        const {now} = this.session;
        if (this.shown === now) return;
        this.shown = now;
        this.preview = null;
        this.draw();
        if (this.shapes.root.visible && this.kind !== null) this.attach();
        this.changed();
    }

    private draw(): void {
        const {boxes: all, box: index, kind} = this.session.now;
        const drawn = this.preview === null ? all : boxes.replace(all, index, this.preview);
        this.shapes.show(drawn, kind, this.selected === null ? -1 : index, this.handles === 'size');
        this.stage.draw();
    }

    private attach(): void {
        const box = this.selected;
        if (box === null || this.handles === 'size') {
            this.gizmo.detach();
            return;
        }
        this.pivot.position.fromArray(box.position);
        this.pivot.quaternion.copy(boxes.quaternionOf(box));
        const mode = this.handles === 'move' ? 'translate' : 'rotate';
        this.gizmo.attach(this.pivot, mode, () => this.follow(box), () => this.finish(), this.snapping);
    }

    private follow(box: Box): void {
        if (this.handles === 'rotate') {
            this.show({...box, rotation: boxes.degreesOf(this.pivot.quaternion)});
            return;
        }
        const position = snapPosition(box.position, this.pivot.position.toArray(), this.snapping.step);
        this.pivot.position.fromArray(position);
        this.show({...box, position});
    }

    /** While a handle is dragged: what it would become. */
    private show(box: Box): void {
        this.preview = box;
        this.draw();
        this.changed();
    }

    private finish(): void {
        const {preview} = this;
        this.preview = null;
        if (preview !== null) this.become(preview);
    }
}
