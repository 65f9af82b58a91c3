// SPDX-License-Identifier: Apache-2.0
// Probe groups by hand.
import {StoredFile, titleOf} from '../page/api';
import {counted, countedTetrahedra} from '../page/colors';
import {button, element, labelled, setVector, vectorInput} from '../page/dom';
import type {PointerUse} from '../view/pointer';
import type {Snapping} from '../view/snapping';
import type {Viewer} from '../view/viewer';
import type {EditSession} from './edit_session';
import {GridForm} from './grid_form';
import * as groups from './groups';
import {GroupsEditor} from './groups_editor';
import {GroupsPointer} from './groups_pointer';
import {readGroups} from './stored_groups';

export class GroupsPanel {
    readonly element: HTMLElement;
    readonly editor: GroupsEditor;
    readonly pointer: PointerUse;
    private readonly grid: GridForm;
    private readonly facts = element('p', {class: 'facts', 'aria-live': 'polite'});
    private readonly list = element('select', {'aria-label': 'Probe group to add to'});
    private readonly groupName = element('input', {type: 'text', maxlength: 200, change: () => this.rename()});
    private readonly takeThose = button('Take those of the volume', () => this.take());
    private readonly openStored: HTMLButtonElement;
    private readonly selectAll = button('Select all', () => this.editor.selectAll(), {title: 'Ctrl+A'});
    private readonly duplicate = button('Duplicate', () => this.editor.duplicateSelected(), {title: 'Ctrl+D'});
    private readonly remove = button('Delete', () => this.editor.removeSelected(), {title: 'Del'});
    private readonly saveGroups = button('Save', () => void this.viewer.alerts.attempt('save groups', () => this.save()), {class: 'main'});
    private readonly selected = element('div');
    private readonly stored = element('select', {'aria-label': 'Stored probe groups'});
    private readonly name = element('input', {type: 'text', maxlength: 200, value: 'groups'});

    constructor(private readonly viewer: Viewer, private readonly session: EditSession, private readonly snapping: Snapping,
                private readonly saved: (file: StoredFile) => void) {
        this.editor = new GroupsEditor(session, viewer.stage, viewer.gizmo, viewer.api, () => this.show(), viewer.alerts, snapping);
        this.openStored = button('Open', () => void viewer.alerts.attempt('open groups', () =>
            this.open(this.stored.value).catch(error => this.listStored().then(() => { throw error; }))));
        this.stored.addEventListener('change', () => this.show());
        this.list.addEventListener('change', () => {
            this.editor.group = this.list.selectedIndex;
            this.show();
        });
        const {editor} = this;
        this.grid = new GridForm(viewer, session, (generated, name) => {
            editor.open(generated);
            this.name.value = name;
        });
        this.element = element(
            'section', {'aria-label': 'Probe groups'},
            element('div', {class: 'buttons'},
                    this.takeThose, this.stored, this.openStored),
            this.facts, labelled('Group', this.list), labelled('Name of the group', this.groupName),
            element('div', {class: 'buttons'},
                    button('New group', () => this.addGroup()),
                    button('Add probe', () => editor.addAt(this.target()), {title: 'A: where the camera looks at'}),
                    this.selectAll, this.duplicate, this.remove),
            this.selected,
            element('p', {class: 'hint'}, 'Click a probe to select it, with Ctrl to add it; drag with Shift to ' +
                    'select a box. Arrow keys with Alt, Page Up and Page Down move what is selected.'),
            element('h2', {}, 'Save'), labelled('Name', this.name),
            element('div', {class: 'buttons'}, this.saveGroups),
            element('h2', {}, 'Generate'), this.grid.element);
        this.pointer = new GroupsPointer(viewer, editor);
        viewer.onChange(() => this.show());
        this.show();
    }

    set isActive(isActive: boolean) {
        if (this.viewer.marks.balls !== null) this.editor.ballRadius = 1.2 * this.viewer.marks.balls.radius;
        this.editor.isActive = isActive;
        if (isActive && this.editor.now.length === 0) this.take();
        if (isActive) void this.viewer.alerts.attempt('list', () => this.listStored());
    }

    async open(reference: string): Promise<void> {
        if (reference === '') return;
        this.openKept(await readGroups(this.viewer.api, reference));
        const file = await this.viewer.api.get<StoredFile>(`/v1/groups/${encodeURIComponent(reference)}`);
        if (file.name !== '') this.name.value = file.name;
    }

    private take(): void {
        if (this.viewer.volume !== null) this.openKept(groups.groupsOfVolume(this.viewer.volume.probes.data));
    }

    private openKept(found: groups.Groups): void {
        this.session.keepGroups(found);
        this.editor.open(found);
    }

    private async listStored(): Promise<void> {
        const files = await this.viewer.api.list('groups');
        this.stored.replaceChildren(element('option', {value: ''}, 'Stored groups…'), ...files.map(
            file => element('option', {value: file.id}, titleOf(file))));
        this.show();
    }

    async save(): Promise<StoredFile> {
        const name = this.name.value;
        const file = await this.editor.save(name).catch(error => {
            this.viewer.say('The groups are not saved.');
            throw error;
        });
        this.viewer.say(`Saved as ${name || file.name || file.id}.`);
        await this.listStored();
        this.stored.value = file.id;
        this.show();
        this.saved(file);
        return file;
    }

    private target(): groups.Position {
        return this.viewer.stage.controls.target.toArray();
    }

    private addGroup(): void {
        this.editor.edit(groups.addGroup(this.editor.now, 'group'));
        this.editor.group = this.editor.now.length - 1;
        this.show();
    }

    private rename(): void {
        const {editor, groupName: {value}} = this;
        const name = value.trim();
        if (name === '' || name === editor.now[this.list.selectedIndex]?.name) this.show();
        else editor.edit(groups.rename(editor.now, this.list.selectedIndex, name), editor.selection);
    }

    show(): void {
        const {editor} = this;
        const {now, selection, joined: {tetrahedra}} = editor;
        const probeCount = groups.countOf(now);
        const joinedWords = tetrahedra === null || probeCount < 4 ? '' : `, joined by ${countedTetrahedra(tetrahedra)}`;
        this.facts.textContent = now.length === 0 ? 'No groups are open.' :
            `${counted(probeCount, 'probe')} in ${counted(now.length, 'group')}` + joinedWords;
        this.list.replaceChildren(...now.map(
            (group, i) => element('option', {value: i}, `${group.name} (${group.positions.length})`)));
        this.list.selectedIndex = Math.min(editor.group, now.length - 1);
        if (document.activeElement !== this.groupName) this.groupName.value = now[this.list.selectedIndex]?.name ?? '';
        this.groupName.disabled = now.length === 0;
        this.takeThose.disabled = this.viewer.volume === null;
        this.openStored.disabled = this.stored.value === '';
        this.selectAll.disabled = this.saveGroups.disabled = probeCount === 0;
        this.duplicate.disabled = this.remove.disabled = selection.length === 0;
        this.grid.show();
        this.showSelection(selection);
    }

    private showSelection(selection: readonly groups.Ref[]): void {
        if (selection.length !== 1) {
            this.selected.replaceChildren(element('p', {class: 'facts'}, selection.length === 0 ?
                'Nothing is selected.' : `${selection.length} probes are selected.`));
            return;
        }
        const [{group, index}] = selection;
        const p = this.editor.now[group].positions[index];
        const legend = `Position of probe ${index} of ${this.editor.now[group].name}`;
        const old = this.selected.querySelector('fieldset');
        if (old?.querySelector('legend')?.textContent === legend) {
            setVector(old, p);
            return;
        }
        this.selected.replaceChildren(vectorInput(legend, p, {step: 0.25}, to => {
            const now = this.editor.now[group].positions[index];
            this.editor.moveBy([to[0] - now[0], to[1] - now[1], to[2] - now[2]]);
        }));
    }

    key(event: KeyboardEvent, isControl: boolean): (() => void) | undefined {
        const {editor} = this;
        const step = this.snapping.step || (this.viewer.marks.balls?.radius ?? 0.1);
        const acts: Record<string, (() => void) | undefined> = isControl ? {
            a: () => editor.selectAll(), d: () => editor.duplicateSelected(),
        } : event.altKey ? {
            ArrowLeft: () => editor.moveBy([-step, 0, 0]), ArrowRight: () => editor.moveBy([step, 0, 0]),
            ArrowUp: () => editor.moveBy([0, 0, -step]), ArrowDown: () => editor.moveBy([0, 0, step]),
        } : {
            Delete: () => editor.removeSelected(), Backspace: () => editor.removeSelected(),
            a: () => editor.addAt(this.target()), Escape: () => editor.select([]),
            PageUp: () => editor.moveBy([0, step, 0]), PageDown: () => editor.moveBy([0, -step, 0]),
        };
        return acts[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    }
}
