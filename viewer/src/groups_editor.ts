// SPDX-License-Identifier: Apache-2.0
// Probe groups by hand, in 3D: what is chosen, moved, undone; the server joins the probes meanwhile.
import type {Volume} from 'tetralight';
import * as three from 'three';

import type {Alerts} from './alerts';
import type {Api, StoredFile} from './api';
import {edgesOf} from './cell_edges';
import {CellLines} from './cell_lines';
import * as groups from './groups';
import type {Gizmo} from './gizmo';
import {Newest} from './newest';
import {pickBall, ProbeBalls} from './probe_balls';
import type {Stage} from './stage';
import {readVolume} from './volume';

interface Edit {
    groups: groups.Groups;
    selection: readonly groups.Ref[];
}

export class GroupsEditor {
    readonly root = new three.Group();
    /** How many join the probes as they are now; not known while the server works. */
    tetrahedra: number | null = null;
    group = 0;
    private history = new groups.History<Edit>({groups: [], selection: []});
    private readonly kept = new WeakSet<groups.Groups>();
    private readonly saved = new Set<string>();
    private balls: ProbeBalls | null = null;
    private refs: groups.Ref[] = [];
    private positions: Float32Array = new Float32Array();
    private readonly lines = new CellLines(0x9aa7b8);
    private readonly pivot = new three.Object3D();
    private pivotStart = new three.Vector3();
    private dragged: Float32Array = new Float32Array();
    private radius = 0.15;
    private readonly newest: Newest<groups.Groups, Volume | null>;

    constructor(private readonly stage: Stage, private readonly gizmo: Gizmo, private readonly api: Api,
                private readonly changed: () => void, alerts: Alerts) {
        this.root.add(this.lines.group, this.pivot);
        this.root.visible = false;
        stage.scene.add(this.root);
        this.newest = new Newest(now => this.join(now), joined => {
            alerts.succeed('join');
            this.showJoined(joined);
        }, error => alerts.report('join', error));
    }

    get now(): groups.Groups {
        return this.history.now.groups;
    }

    get selection(): readonly groups.Ref[] {
        return this.history.now.selection;
    }

    get canUndo(): boolean {
        return this.history.canUndo;
    }

    get canRedo(): boolean {
        return this.history.canRedo;
    }

    /** Whether the groups are neither stored nor those of a volume. */
    get isUnsaved(): boolean {
        return this.now.length > 0 && !this.kept.has(this.now);
    }

    set isActive(isActive: boolean) {
        this.root.visible = isActive;
        this.showGizmo();
        this.stage.draw();
    }

    set ballRadius(radius: number) {
        this.radius = radius;
        if (this.balls !== null) this.balls.radius = radius;
    }

    /** Others instead of those that are open; undo brings these back. */
    open(opened: groups.Groups): void {
        if (this.now.length === 0) this.history = new groups.History<Edit>({groups: opened, selection: []});
        else this.history.become({groups: opened, selection: []});
        this.group = 0;
        this.refresh(true);
    }

    /** These are to be found elsewhere, too. */
    keep(found: groups.Groups): void {
        this.kept.add(found);
    }

    async save(name: string): Promise<StoredFile> {
        const {now} = this;
        const text = groups.formatGroups(now);
        this.saved.add(text);  // at once: who joins them meanwhile leaves them
        const {file} = await this.api.upload('groups', text, name);
        this.keep(now);
        return file;
    }

    undo(): void {
        this.history.undo();
        this.refresh(true);
    }

    redo(): void {
        this.history.redo();
        this.refresh(true);
    }

    edit(edited: groups.Groups, selection: readonly groups.Ref[] = []): void {
        this.history.become({groups: edited, selection});
        this.refresh(true);
    }

    /** Choosing is no edit: undo steps over it. */
    select(selection: readonly groups.Ref[]): void {
        const state = this.history.now as {selection: readonly groups.Ref[]};
        state.selection = selection;
        this.refresh(false);
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

    private refresh(isEdit: boolean): void {
        this.refs = groups.allRefs(this.now);
        this.positions = groups.positionsOf(this.now);
        this.showBalls(this.positions);
        this.showGizmo();
        if (isEdit) this.askToJoin(this.now);
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
        this.root.add(this.balls.mesh);
    }

    private showGizmo(): void {
        if (!this.root.visible) return;
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
        this.gizmo.attach(this.pivot, 'translate', () => this.preview(), () => this.finishDrag());
    }

    private get way(): three.Vector3 {
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
        this.askToJoin(groups.move(this.now, this.selection, way));
        this.stage.draw();
    }

    private finishDrag(): void {
        const way = this.way;
        if (way.length() > 0) this.moveBy(way.toArray());
    }

    /** What could not be joined, because there was no server. */
    askAgain(): void {
        if (this.tetrahedra === null && this.now.length > 0) this.newest.ask(this.now);
    }

    private askToJoin(now: groups.Groups): void {
        this.tetrahedra = null;
        this.newest.ask(now);
    }

    /** What the server makes of the probes; it keeps nothing of it but what was saved. */
    private async join(now: groups.Groups): Promise<Volume | null> {
        if (groups.countOf(now) === 0) return null;
        const text = groups.formatGroups(now);
        const kept = [await this.api.upload('groups', text)];
        const paths = [`/v1/groups/${kept[0].file.id}`];
        try {
            kept.push(await this.api.keep('/v1/tetrahedralize', {groups: [kept[0].file.id]}));
            paths.push(`/v1/volumes/${kept[1].file.id}`);
            return readVolume(await this.api.bytes(`${paths[1]}/file`), 'of these groups');
        } finally {
            const made = paths.filter((_, i) => kept[i].isNew && (i > 0 || !this.saved.has(text)));
            await Promise.all(made.map(path => this.api.remove(path).catch(() => {})));
        }
    }

    private showJoined(joined: Volume | null): void {
        if (joined === null) {
            this.lines.clear();
        } else {
            const {exactPositions, cells, info: {innerCellCount}} = joined.data;
            this.lines.show(new Float32Array(exactPositions), edgesOf(cells, innerCellCount));
        }
        if (!this.newest.isWaiting) this.tetrahedra = joined?.data.info.innerCellCount ?? null;
        this.changed();
        this.stage.draw();
    }
}
