// SPDX-License-Identifier: Apache-2.0
// The tab Edit: probe groups and the boxes of a scene, with one selection and one history.
import * as three from 'three';

import type {StoredFile} from '../page/api';
import {button, checkbox, element, numberInput, radios} from '../page/dom';
import type {PointerUse} from '../view/pointer';
import {Snapping} from '../view/snapping';
import type {Viewer} from '../view/viewer';
import {BoxEditor, Handles} from './box_editor';
import {kBoxKinds} from './box_kinds';
import {outlineOf} from './box_shapes';
import {areSame, Box} from './boxes';
import {BoxesPanel} from './boxes_panel';
import {CoverageView} from './coverage_view';
import {EditKind, EditSession} from './edit_session';
import {GroupsPanel} from './groups_panel';
import {boxesOf} from './scene_boxes';

interface KindPanel {
    readonly element: HTMLElement;
    show(): void;
    /** What a key does, if anything. */
    key(event: KeyboardEvent, isControl: boolean): (() => void) | undefined;
}

export class EditPanel {
    readonly element: HTMLElement;
    readonly session = new EditSession();
    readonly snapping = new Snapping();
    readonly groups: GroupsPanel;
    readonly boxes: BoxEditor;
    readonly pointer: PointerUse;
    readonly coverage: CoverageView;
    private readonly panels: Record<EditKind, KindPanel>;
    private readonly boxPanels: BoxesPanel[];
    private readonly undo = button('Undo', () => this.undoEdit(), {title: 'Ctrl+Z'});
    private readonly redo = button('Redo', () => this.session.redo(), {title: 'Ctrl+Y'});
    private readonly place = element('div');
    private readonly kinds = radios<EditKind>('What to edit', [
        ['groups', 'Probe groups'],
        ...Object.values(kBoxKinds).map(({id, title}): [EditKind, string] => [id, title]),
    ], kind => this.session.choose({kind}), 'grid');
    private readonly handles = radios<Handles>('Handles', [
        ['move', 'Move', 'W'], ['rotate', 'Rotate', 'E'], ['size', 'Size', 'R']], handles => { this.boxes.handles = handles; });
    private shownKind: EditKind | null = null;
    private isActiveNow = false;
    private scene = '';

    constructor(private readonly viewer: Viewer, savedGroups: (file: StoredFile) => void, savedScene: () => void) {
        const {session, snapping} = this;
        const {stage, gizmo} = viewer;
        this.groups = new GroupsPanel(viewer, session, snapping, savedGroups);
        this.boxes = new BoxEditor(session, stage, gizmo, snapping, () => this.show());
        this.boxPanels = Object.values(kBoxKinds).map(
            ({id}) => new BoxesPanel(id, viewer, session, this.boxes, snapping, savedScene));
        this.coverage = new CoverageView(viewer, session, this.groups.editor);
        const [adjustments, portals, reflections] = this.boxPanels;
        this.panels = {groups: this.groups, adjustments, portals, reflections};
        this.pointer = this.makePointer();
        this.element = element(
            'div', {keydown: (event: KeyboardEvent) => this.key(event)},
            this.kinds.element, element('div', {class: 'buttons'}, this.undo, this.redo), this.handles.element,
            this.snappingForm(), this.coverage.element, this.place);
        stage.canvas.addEventListener('keydown', event => {
            if (this.isActiveNow) this.key(event);
        });
        addEventListener('beforeunload', event => {
            if (session.hasUnsavedGroups || session.hasUnsavedBoxes) event.preventDefault();
        });
        viewer.onChange(() => this.followScene());
        session.onChange(() => this.show());
        this.followScene();
        this.show();
    }

    set isActive(isActive: boolean) {
        this.isActiveNow = isActive;
        this.groups.isActive = isActive;
        this.boxes.isActive = isActive;
        this.coverage.isActive = isActive;
        if (isActive) this.show();
    }

    /** What F frames: all that is selected, or everything. */
    frame(): void {
        const {stage, marks, box: all} = this.viewer;
        const {kind, probes, groups} = this.session.now;
        const box = new three.Box3();
        if (kind !== 'groups' && this.boxes.selected !== null) box.setFromPoints(outlineOf(this.boxes.selected));
        if (kind === 'groups') {
            for (const {group, index} of probes) box.expandByPoint(new three.Vector3(...groups[group].positions[index]));
            if (!box.isEmpty()) box.expandByScalar(5 * (marks.balls?.radius ?? 0.1));
        }
        stage.frame((box.isEmpty() ? all : box).getBoundingSphere(new three.Sphere()), box.isEmpty() ? 0.9 : 0.6);
    }

    private followScene(): void {
        const {model, sceneFile} = this.viewer;
        if ((sceneFile?.id ?? '') === this.scene) return;
        this.scene = sceneFile?.id ?? '';
        const boxes = model === null ? [] : boxesOf(model.json);
        if (areSame(boxes, this.session.now.boxes)) this.session.keepBoxes(this.session.now.boxes);
        else this.openBoxes(boxes);
        for (const panel of this.boxPanels) panel.followScene();
    }

    private undoEdit(): void {
        this.session.undo();
        this.viewer.alerts.succeed('boxes');
    }

    private openBoxes(boxes: readonly Box[]): void {
        const areLost = this.session.hasUnsavedBoxes;
        this.session.openBoxes(boxes);
        if (areLost) {
            this.viewer.alerts.report('boxes', 'The boxes of the last scene were not saved. Undo in the tab Edit brings ' +
                                      'them back, in place of the boxes of this scene; Redo brings these back.');
        }
    }

    private show(): void {
        const {session: {now: {kind}, canUndo, canRedo}} = this;
        this.undo.disabled = !canUndo;
        this.redo.disabled = !canRedo;
        this.kinds.value = kind;
        this.handles.value = this.boxes.handles;
        this.handles.element.hidden = kind === 'groups';
        this.groups.editor.showsProbes = kind === 'groups' || !this.viewer.hidden.has('probes');
        if (kind !== this.shownKind) this.place.replaceChildren(this.panels[kind].element);
        this.shownKind = kind;
        this.panels[kind].show();
    }

    private snappingForm(): HTMLElement {
        const {snapping} = this;
        const summary = element('summary');
        const apply = () => {
            summary.textContent = snapping.isOn ? `Snapping: ${snapping.meters} m, ${snapping.degrees}°` : 'Snapping: off';
            this.boxes.handles = this.boxes.handles;  // the handles take the steps
        };
        apply();
        const meters = numberInput('Step, metres', {min: 0.001, step: 0.05, value: snapping.meters}, value => {
            snapping.meters = value;
            apply();
        });
        const degrees = numberInput('Angle, degrees', {min: 0.1, max: 180, step: 1, value: snapping.degrees}, value => {
            snapping.degrees = value;
            apply();
        });
        return element('details', {}, summary,
                       checkbox('Snap to steps', snapping.isOn, isOn => {
                           snapping.isOn = isOn;
                           apply();
                       }), meters, degrees,
                       element('p', {class: 'hint'}, 'Hold Ctrl while you drag a handle to move freely.'));
    }

    private key(event: KeyboardEvent): void {
        if ((event.target as HTMLElement).matches('input:not([type=radio], [type=checkbox]), select')) return;
        const {session} = this;
        const isControl = event.ctrlKey || event.metaKey;
        const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
        const shared: Record<string, (() => void) | undefined> = isControl ? {
            z: () => event.shiftKey ? session.redo() : this.undoEdit(), y: () => session.redo(),
        } : session.now.kind === 'groups' || event.altKey ? {} : {
            w: () => { this.boxes.handles = 'move'; }, e: () => { this.boxes.handles = 'rotate'; },
            r: () => { this.boxes.handles = 'size'; },
        };
        const act = shared[key] ?? this.panels[session.now.kind].key(event, isControl);
        if (act === undefined) return;
        event.preventDefault();
        act();
    }

    private makePointer(): PointerUse {
        const {gizmo} = this.viewer;
        const isOfGroups = () => this.session.now.kind === 'groups';
        const {pointer} = this.groups;
        return {
            press: (x, y, event) => isOfGroups() ? pointer.press!(x, y, event) : !gizmo.isHot && this.boxes.press(x, y),
            drag: (x, y) => isOfGroups() ? pointer.drag!(x, y) : this.boxes.dragTo(x, y),
            release: (x, y) => isOfGroups() ? pointer.release!(x, y) : this.boxes.release(),
            click: (x, y, event) => {
                if (isOfGroups()) pointer.click!(x, y, event);
                else if (!gizmo.isHot && !gizmo.isDragging) this.boxes.click(x, y);
            },
        };
    }
}
