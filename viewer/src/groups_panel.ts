// SPDX-License-Identifier: Apache-2.0
// Probe groups by hand.
import {Missing} from './alerts';
import {StoredFile, titleOf} from './api';
import {button, element, labelled, numberToSend, select, setVector, vectorInput} from './dom';
import {counted, countedTetrahedra} from './colors';
import * as groups from './groups';
import {GroupsEditor} from './groups_editor';
import type {PointerUse} from './pointer';
import type {Viewer} from './viewer';

export class GroupsPanel {
    readonly element: HTMLElement;
    readonly editor: GroupsEditor;
    readonly pointer: PointerUse;
    private readonly facts = element('p', {class: 'facts', 'aria-live': 'polite'});
    private readonly list = element('select', {'aria-label': 'Probe group to add to'});
    private readonly undo: HTMLButtonElement;
    private readonly redo: HTMLButtonElement;
    private readonly takeThose = button('Take those of the volume', () => this.take());
    private readonly openStored: HTMLButtonElement;
    private readonly selectAll = button('Select all', () => this.editor.selectAll(), {title: 'Ctrl+A'});
    private readonly duplicate = button('Duplicate', () => this.editor.duplicateSelected(), {title: 'Ctrl+D'});
    private readonly remove = button('Delete', () => this.editor.removeSelected(), {title: 'Del'});
    private readonly selected = element('div');
    private readonly stored = element('select', {'aria-label': 'Stored probe groups'});
    private readonly name = element('input', {type: 'text', maxlength: 200, value: 'groups'});
    private readonly previewState = element('p', {class: 'facts', role: 'status'});
    private preview: groups.Groups | null = null;
    private isGenerating = false;
    private readonly frame = element('div', {class: 'frame', hidden: true});

    constructor(private readonly viewer: Viewer, private readonly saved: (file: StoredFile) => void) {
        this.editor = new GroupsEditor(viewer.stage, viewer.gizmo, viewer.api, () => this.show(), viewer.alerts);
        this.undo = button('Undo', () => this.editor.undo(), {title: 'Ctrl+Z'});
        this.redo = button('Redo', () => this.editor.redo(), {title: 'Ctrl+Y'});
        this.openStored = button('Open', () => void viewer.alerts.attempt('open groups', () => this.open(this.stored.value)));
        this.stored.addEventListener('change', () => this.show());
        this.list.addEventListener('change', () => { this.editor.group = this.list.selectedIndex; });
        const {editor} = this;
        this.element = element(
            'section', {'aria-label': 'Probe groups', keydown: (event: KeyboardEvent) => this.key(event)},
            element('div', {class: 'buttons'},
                    this.takeThose, this.stored, this.openStored),
            this.facts, labelled('Group', this.list),
            element('div', {class: 'buttons'},
                    button('New group', () => this.addGroup()),
                    button('Add probe', () => editor.addAt(this.target()), {title: 'A: where the camera looks at'}),
                    this.selectAll, this.duplicate, this.remove, this.undo, this.redo),
            this.selected,
            element('p', {class: 'hint'}, 'Click a probe to select it, with Ctrl to add it; drag with Shift to ' +
                    'select a box. Arrow keys with Alt, Page Up and Page Down move what is selected.'),
            element('h2', {}, 'Save'), labelled('Name', this.name),
            element('div', {class: 'buttons'},
                    button('Save', () => void viewer.alerts.attempt('save groups', () => this.save()), {class: 'main'})),
            element('h2', {}, 'Generate'), this.gridForm());
        viewer.stage.parent.append(this.frame);
        viewer.stage.canvas.addEventListener('keydown', event => {
            if (this.editor.root.visible) this.key(event);
        });
        addEventListener('beforeunload', event => {
            if (this.editor.isUnsaved) event.preventDefault();
        });
        this.pointer = this.makePointer();
        viewer.onChange(() => this.show());
        this.show();
    }

    set isActive(isActive: boolean) {
        if (this.viewer.balls !== null) this.editor.ballRadius = 1.2 * this.viewer.balls.radius;
        this.editor.isActive = isActive;
        if (isActive && this.editor.now.length === 0) this.take();
        if (isActive) void this.viewer.alerts.attempt('list', () => this.listStored());
    }

    async open(reference: string): Promise<void> {
        if (reference === '') return;
        this.openKept(await this.read(reference));
        const file = await this.viewer.api.get<StoredFile>(`/v1/groups/${encodeURIComponent(reference)}`);
        if (file.name !== '') this.name.value = file.name;
    }

    private async read(reference: string): Promise<groups.Groups> {
        const answer = await this.viewer.api.request('GET', `/v1/groups/${encodeURIComponent(reference)}/file`);
        return groups.parseGroups(await answer.text());
    }

    private take(): void {
        if (this.viewer.volume !== null) this.openKept(groups.groupsOfVolume(this.viewer.volume.probes.data));
    }

    private openKept(found: groups.Groups): void {
        this.editor.keep(found);
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

    private show(): void {
        const {editor} = this;
        const {now, selection, tetrahedra} = editor;
        const probeCount = groups.countOf(now);
        const joinedWords = tetrahedra === null || probeCount < 4 ? '' : `, joined by ${countedTetrahedra(tetrahedra)}`;
        this.facts.textContent = now.length === 0 ? 'No groups are open.' :
            `${counted(probeCount, 'probe')} in ${counted(now.length, 'group')}` + joinedWords;
        this.list.replaceChildren(...now.map(
            (group, i) => element('option', {value: i}, `${group.name} (${group.positions.length})`)));
        this.list.selectedIndex = Math.min(editor.group, now.length - 1);
        this.undo.disabled = !editor.canUndo;
        this.redo.disabled = !editor.canRedo;
        this.takeThose.disabled = this.viewer.volume === null;
        this.openStored.disabled = this.stored.value === '';
        this.selectAll.disabled = probeCount === 0;
        this.duplicate.disabled = this.remove.disabled = selection.length === 0;
        this.showPreviewState();
        this.showSelection(selection);
    }

    private showPreviewState(): void {
        const isPreview = this.editor.now === this.preview && this.editor.isUnsaved;
        this.previewState.textContent = this.isGenerating ? 'Generating…' :
            isPreview ? 'This is a preview: give it a name and save it, or open other groups.' : '';
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

    private key(event: KeyboardEvent): void {
        if ((event.target as HTMLElement).matches('input, select')) return;
        const {editor} = this;
        const step = this.viewer.balls?.radius ?? 0.1;
        const isControl = event.ctrlKey || event.metaKey;
        const acts: Record<string, (() => void) | undefined> = isControl ? {
            z: () => event.shiftKey ? editor.redo() : editor.undo(), y: () => editor.redo(),
            a: () => editor.selectAll(), d: () => editor.duplicateSelected(),
        } : event.altKey ? {
            ArrowLeft: () => editor.moveBy([-step, 0, 0]), ArrowRight: () => editor.moveBy([step, 0, 0]),
            ArrowUp: () => editor.moveBy([0, 0, -step]), ArrowDown: () => editor.moveBy([0, 0, step]),
        } : {
            Delete: () => editor.removeSelected(), Backspace: () => editor.removeSelected(),
            a: () => editor.addAt(this.target()), Escape: () => editor.select([]),
            PageUp: () => editor.moveBy([0, step, 0]), PageDown: () => editor.moveBy([0, -step, 0]),
        };
        const act = acts[event.key.length === 1 ? event.key.toLowerCase() : event.key];
        if (act === undefined) return;
        event.preventDefault();
        act();
    }

    private makePointer(): PointerUse {
        let start = {x: 0, y: 0};
        const rectangle = (x: number, y: number) => ({
            left: Math.min(x, start.x), top: Math.min(y, start.y),
            right: Math.max(x, start.x), bottom: Math.max(y, start.y),
        });
        return {
            press: (x, y, event) => {
                start = {x, y};
                return event.shiftKey && !this.viewer.gizmo.isHot;
            },
            drag: (x, y) => {
                const box = this.viewer.stage.parent.getBoundingClientRect();
                const r = rectangle(x, y);
                this.frame.hidden = false;
                this.frame.style.left = `${r.left - box.left}px`;
                this.frame.style.top = `${r.top - box.top}px`;
                this.frame.style.width = `${r.right - r.left}px`;
                this.frame.style.height = `${r.bottom - r.top}px`;
            },
            release: (x, y) => {
                this.frame.hidden = true;
                const r = rectangle(x, y);
                this.editor.selectBox(r.left, r.top, r.right, r.bottom);
            },
            click: (x, y, event) => {
                if (this.viewer.gizmo.isHot || this.viewer.gizmo.isDragging) return;
                const ref = this.editor.pick(x, y);
                if (ref !== null && (event.ctrlKey || event.metaKey)) this.editor.toggle(ref);
                else this.editor.select(ref === null ? [] : [ref]);
            },
        };
    }

    /** The server's grid generator: its groups are opened here, to look at, change and save. */
    private gridForm(): HTMLElement {
        const mode = select([['regular', 'regular: a lattice'], ['layers', 'layers: above every floor'],
                             ['surface', 'surface: on both sides of walls'],
                             ['adaptive', 'adaptive: where light changes']], 'regular', () => {});
        const spacing = element('input', {type: 'number', min: 0.05, step: 0.25, value: 2});
        const most = element('input', {type: 'number', min: 1, step: 100, value: 5000});
        const generate = async () => {
            if (this.viewer.sceneFile === null) throw new Missing('Open a scene first: the generator fills it with probes.');
            const order = {
                scene: this.viewer.sceneFile.id, mode: mode.value, spacing: numberToSend(spacing),
                max_probes: numberToSend(most),
            };
            this.isGenerating = true;
            this.showPreviewState();
            try {
                const {file, isNew} = await this.viewer.api.keep('/v1/grid', order);
                this.preview = await this.read(file.id);
                if (isNew) await this.viewer.api.remove(`/v1/groups/${file.id}`);
                this.editor.open(this.preview);
                this.name.value = `grid ${order.mode} ${order.spacing}`;
            } finally {
                this.isGenerating = false;
                this.showPreviewState();
            }
        };
        return element('div', {}, labelled('Mode', mode), labelled('Spacing, metres', spacing),
                       labelled('Maximum number of probes', most),
                       element('div', {class: 'buttons'},
                               button('Preview', () => void this.viewer.alerts.attempt('generate', generate))), this.previewState);
    }
}
