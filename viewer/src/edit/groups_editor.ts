// SPDX-License-Identifier: Apache-2.0
// Probe groups by hand, in 3D: what is selected and moved.
import * as three from 'three';

import {pickBall, ProbeBalls} from '../light/probe_balls';
import type {Alerts} from '../page/alerts';
import type {Api, StoredFile} from '../page/api';
import type {Gizmo} from '../view/gizmo';
import {snap, snapPosition, Snapping} from '../view/snapping';
import type {Stage} from '../view/stage';
import type {EditSession, EditState} from './edit_session';
import * as groups from './groups';
import {JoinedProbes} from './joined_probes';

export class GroupsEditor {
    readonly root = new three.Group();
    readonly joined: JoinedProbes;
    group = 0;
    private shown: EditState | null = null;
    private balls: ProbeBalls | null = null;
    private refs: groups.Ref[] = [];
    private positions: Float32Array = new Float32Array();
    private readonly pivot = new three.Object3D();
    private pivotStart = new three.Vector3();
    private dragged: Float32Array = new Float32Array();
    radius = 0.15;
    private areProbesShown = true;

    constructor(private readonly session: EditSession, private readonly stage: Stage, private readonly gizmo: Gizmo,
                private readonly api: Api, private readonly changed: () => void, alerts: Alerts,
                private readonly snapping = new Snapping()) {
        this.joined = new JoinedProbes(api, alerts);
        this.root.add(this.joined.lines.group, this.pivot);
        this.root.visible = false;
        stage.scene.add(this.root);
        this.joined.onChange(() => {
            changed();
            stage.draw();
        });
        session.onChange(() => this.refresh());
    }

    get now(): groups.Groups {
        return this.session.now.groups;
    }

    get selection(): readonly groups.Ref[] {
        return this.session.now.probes;
    }

    set isActive(isActive: boolean) {
        this.root.visible = isActive;
        this.showGizmo();
        this.stage.draw();
    }

    /** Hidden probes are not in the way of boxes. */
    set showsProbes(areShown: boolean) {
        this.areProbesShown = areShown;
        if (this.balls !== null) this.balls.mesh.visible = areShown;
    }

    set ballRadius(radius: number) {
        this.radius = radius;
        if (this.balls !== null) this.balls.radius = radius;
    }

    /** Others instead of those that are open; undo brings these back. */
    open(opened: groups.Groups): void {
        this.group = 0;
        this.session.openGroups(opened);
    }

    async save(name: string): Promise<StoredFile> {
        const {now} = this;
        const text = groups.formatGroups(now);
        this.joined.leave(text);  // before the upload: they may be joined meanwhile
        const {file} = await this.api.upload('groups', text, name);
        this.session.keepGroups(now);
        return file;
    }

    edit(edited: groups.Groups, selection: readonly groups.Ref[] = []): void {
        this.session.edit({groups: edited, probes: selection, kind: 'groups'});
    }

    select(selection: readonly groups.Ref[]): void {
        this.session.choose({probes: selection});
    }

    toggle(ref: groups.Ref): void {
        const key = groups.keyOf(ref);
        const others = this.selection.filter(other => groups.keyOf(other) !== key);
        this.select(others.length < this.selection.length ? others : [...this.selection, ref]);
    }

    addAt(position: groups.Position): void {
        let now = this.now;
        if (now.length === 0) now = groups.addGroup(now, 'group');
        this.group = Math.min(this.group, now.length - 1);
        const index = now[this.group].positions.length;
        this.edit(groups.add(now, this.group, [position]), [{group: this.group, index}]);
    }

    moveBy(by: groups.Position): void {
        if (this.selection.length > 0) this.edit(groups.move(this.now, this.selection, by), this.selection);
    }

    removeSelected(): void {
        if (this.selection.length > 0) this.edit(groups.remove(this.now, this.selection));
    }

    duplicateSelected(): void {
        if (this.selection.length === 0) return;
        const step = 5 * this.radius;
        this.edit(...groups.duplicate(this.now, this.selection, [step, 0, step]));
    }

    selectAll(): void {
        this.select(groups.allRefs(this.now));
    }

    pick(x: number, y: number): groups.Ref | null {
        const probe = pickBall(this.positions, 1.3 * this.radius, this.stage.rayAt(x, y).ray);
        return probe < 0 ? null : this.refs[probe];
    }

    /** All probes whose middle lies in a rectangle of the page. */
    selectBox(left: number, top: number, right: number, bottom: number): void {
        const at = new three.Vector3();
        this.select(this.refs.filter((_, i) => {
            const p = this.stage.pageFrom(at.fromArray(this.positions, 3 * i));
            return p.isInFront && p.x >= left && p.x <= right && p.y >= top && p.y <= bottom;
        }));
    }

    private refresh(): void {
        const {shown, session: {now}} = this;
        const isSame = shown?.groups === now.groups && shown.probes === now.probes;
        this.shown = now;
        if (!isSame) {
            this.refs = groups.allRefs(this.now);
            this.positions = groups.positionsOf(this.now);
            this.showBalls(this.positions);
        }
        this.joined.lines.group.visible = now.kind === 'groups';
        this.showGizmo();
        this.joined.ask(now.groups);
        this.changed();
        this.stage.draw();
    }

    private showBalls(positions: Float32Array): void {
        this.balls?.dispose();
        this.balls = new ProbeBalls(positions, this.radius);
        const selected = new Set(this.selection.map(groups.keyOf));
        const color = new three.Color();
        this.balls.setTint(i => {
            if (selected.has(groups.keyOf(this.refs[i]))) return [1, 0.6, 0, 1];
            color.setHSL((0.55 + 0.618 * this.refs[i].group) % 1, 0.5, 0.6);
            return [color.r, color.g, color.b, 1];
        });
        this.balls.mesh.visible = this.areProbesShown;
        this.root.add(this.balls.mesh);
    }

    private showGizmo(): void {
        if (!this.root.visible || this.session.now.kind !== 'groups') return;
        if (this.selection.length === 0) {
            this.gizmo.detach();
            return;
        }
        const middle = new three.Vector3();
        for (const {group, index} of this.selection) {
            middle.add(new three.Vector3(...this.now[group].positions[index]));
        }
        this.pivot.position.copy(middle.divideScalar(this.selection.length));
        this.pivotStart = this.pivot.position.clone();
        this.gizmo.attach(this.pivot, 'translate', () => this.preview(), () => this.finishDrag(), this.snapping);
    }

    /** One probe comes to multiples of the step; several keep their distances, and move by multiples. */
    private get way(): three.Vector3 {
        const [start, to] = [this.pivotStart.toArray(), this.pivot.position.toArray()];
        const {step} = this.snapping;
        if (this.selection.length === 1) this.pivot.position.fromArray(snapPosition(start, to, step));
        else this.pivot.position.fromArray(start.map((x, i) => x + snap(to[i] - x, step)));
        return this.pivot.position.clone().sub(this.pivotStart);
    }

    /** While handles are dragged: balls move, the groups do not yet. */
    private preview(): void {
        const selected = new Set(this.selection.map(groups.keyOf));
        this.dragged = this.positions.slice();
        const way = this.way.toArray();
        this.refs.forEach((ref, i) => {
            if (!selected.has(groups.keyOf(ref))) return;
            for (let axis = 0; axis < 3; ++axis) this.dragged[3 * i + axis] += way[axis];
        });
        this.showBalls(this.dragged);
        this.joined.ask(groups.move(this.now, this.selection, way));
        this.stage.draw();
    }

    private finishDrag(): void {
        const way = this.way;
        if (way.length() > 0) this.moveBy(way.toArray());
    }
}
