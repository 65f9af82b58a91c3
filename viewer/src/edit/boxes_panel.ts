// SPDX-License-Identifier: Apache-2.0
// One kind of boxes as a list, and the selected one in numbers.
import {Missing} from '../page/alerts';
import type {StoredFile} from '../page/api';
import {button, element, labelled} from '../page/dom';
import {download} from '../page/download';
import {readGlbJson, withGlbJson} from '../scene/glb';
import type {Snapping} from '../view/snapping';
import type {Viewer} from '../view/viewer';
import type {BoxEditor} from './box_editor';
import {BoxFields} from './box_fields';
import {BoxKind, kBoxKinds} from './box_kinds';
import {Box, BoxKindId, freeName, remove} from './boxes';
import type {EditSession} from './edit_session';
import type {Position} from './groups';
import {withBoxes} from './scene_boxes';

export class BoxesPanel {
    readonly element: HTMLElement;
    private readonly list = element('select', {size: 3, change: () => this.editor.select(Number(this.list.value))});
    private readonly add = button('', () => this.editor.addAt(this.target()), {title: 'A: where the camera looks at'});
    private readonly duplicate = button('Duplicate', () => this.editor.duplicateSelected(), {title: 'Ctrl+D'});
    private readonly remove = button('Delete', () => this.editor.removeSelected(), {title: 'Del'});
    private readonly facts = element('p', {class: 'facts', 'aria-live': 'polite'});
    private readonly hint = element('p', {class: 'hint'}, 'Click a box in the view, or its name, to select it.');
    private readonly fields: BoxFields;
    private readonly name = element('input', {type: 'text', maxlength: 200});
    private readonly save: HTMLButtonElement;
    private readonly download: HTMLButtonElement;
    private readonly kind: BoxKind;

    constructor(kind: BoxKindId, private readonly viewer: Viewer, private readonly session: EditSession,
                private readonly editor: BoxEditor, private readonly snapping: Snapping,
                private readonly saved: (file: StoredFile) => void) {
        this.kind = kBoxKinds[kind];
        const {title, one, purpose, file} = this.kind;
        this.list.setAttribute('aria-label', title);
        this.add.textContent = `Add ${one}`;
        this.fields = new BoxFields(this.kind, snapping, box => this.become(box));
        const attempt = (action: string, work: () => Promise<void>) => void viewer.alerts.attempt(action, work);
        this.save = button('Save in the scene', () => attempt('save boxes', () => this.store()), {class: 'main'});
        this.download = button(`Download ${file?.name ?? 'the scene'}`, () => attempt('download boxes', () => this.export()));
        this.element = element(
            'section', {'aria-label': title},
            element('p', {class: 'hint'}, purpose), this.facts, this.list,
            element('div', {class: 'buttons'}, this.add, this.duplicate, this.remove),
            this.hint, this.fields.element,
            element('h2', {}, 'Save'),
            element('p', {class: 'hint'}, 'Boxes of all three kinds are stored in a copy of the scene, which opens here. Its next ' +
                    'bakes and grids use them.'),
            labelled('Name of the scene', this.name),
            element('div', {class: 'buttons'}, this.save, this.download),
            element('p', {class: 'hint'}, file === undefined ? 'The command reads portals from the scene alone.' :
                `The file is for the command: ${file.option} ${file.name}`));
        this.show();
    }

    show(): void {
        const {boxes, box: index} = this.session.now;
        const own = boxes.map((box, i) => ({box, i})).filter(({box}) => box.kind === this.kind.id);
        const hasScene = this.viewer.sceneFile !== null;
        this.list.replaceChildren(...own.map(({box, i}) => element('option', {value: i}, box.name)));
        this.list.value = this.editor.selected === null ? '' : String(index);
        this.list.hidden = own.length === 0;
        this.facts.textContent = !hasScene ? 'Open a scene first: boxes belong to it.' :
            own.length === 0 ? `The scene has no ${this.kind.title.toLowerCase()} yet.` : this.unsaved;
        this.add.disabled = this.save.disabled = this.download.disabled = !hasScene;
        this.duplicate.disabled = this.remove.disabled = this.editor.selected === null;
        this.showFields();
    }

    private get unsaved(): string {
        return this.session.hasUnsavedBoxes ? 'Not saved yet.' : 'All are saved in the scene.';
    }

    /** Another scene is open. */
    followScene(): void {
        const name = this.viewer.sceneFile?.name ?? '';
        this.name.value = name === '' || name.endsWith(' edited') ? name : `${name} edited`;
        this.show();
    }

    private showFields(): void {
        const box = this.editor.selected;
        this.hint.hidden = box !== null || this.list.hidden;
        this.fields.element.hidden = box === null;
        if (box !== null) this.fields.show(box);
    }

    /** Names are those of one box of a kind. */
    private become(box: Box): void {
        const {boxes, box: index} = this.session.now;
        const isRenamed = box.name !== boxes[index].name;
        this.editor.become(isRenamed ? {...box, name: freeName(remove(boxes, index), box.kind, box.name)} : box);
    }

    key(event: KeyboardEvent, isControl: boolean): (() => void) | undefined {
        const {editor} = this;
        if (isControl) return event.key.toLowerCase() === 'd' ? () => editor.duplicateSelected() : undefined;
        const step = this.snapping.step || 0.05;
        const moves: Record<string, Position> = event.altKey ? {
            ArrowLeft: [-step, 0, 0], ArrowRight: [step, 0, 0], ArrowUp: [0, 0, -step], ArrowDown: [0, 0, step],
        } : {PageUp: [0, step, 0], PageDown: [0, -step, 0]};
        const move = moves[event.key];
        if (move !== undefined) return () => editor.moveBy(move);
        return {
            Delete: () => editor.removeSelected(), Backspace: () => editor.removeSelected(),
            a: () => this.add.disabled || editor.addAt(this.target()), Escape: () => editor.select(-1),
        }[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    }

    private target(): Position {
        return this.viewer.stage.controls.target.toArray();
    }

    /** The bytes of the scene with all boxes. */
    private async scene(): Promise<ArrayBuffer> {
        const {sceneFile, api} = this.viewer;
        if (sceneFile === null) throw new Missing('Open a scene first: boxes are saved in it.');
        const {boxes} = this.session.now;
        for (const box of boxes) check(box);
        const glb = await api.bytes(`/v1/scenes/${sceneFile.id}/file`);
        return withGlbJson(glb, withBoxes(readGlbJson(glb), boxes));
    }

    private async store(): Promise<void> {
        const {viewer: {api, say, stage, alerts}, session} = this;
        const {boxes} = session.now;
        const name = this.name.value;
        try {
            const {file} = await api.upload('scenes', await this.scene(), name);
            session.keepBoxes(boxes);
            const [eye, target] = [stage.camera.position.toArray(), stage.controls.target.toArray()];
            await this.viewer.open.scene(file.id);
            stage.look(eye, target);
            say(`Saved as ${name || file.id.slice(0, 8)}.`);
            alerts.succeed('save boxes');
            this.saved(file);
        } catch (error) {
            say('The boxes are not saved.');
            throw error;
        }
    }

    private async export(): Promise<void> {
        const {file, id} = this.kind;
        if (file === undefined) {
            download(`${this.name.value || 'scene'}.glb`, await this.scene(), 'model/gltf-binary');
            return;
        }
        const own = this.session.now.boxes.filter(box => box.kind === id);
        for (const box of own) check(box);
        download(file.name, file.text(own), 'application/json');
    }
}

function check(box: Box): void {
    const {one, fault} = kBoxKinds[box.kind];
    const words = fault(box);
    if (words !== '') throw new Error(`The ${one} "${box.name}" ${words}.`);
}
