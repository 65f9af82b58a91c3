// SPDX-License-Identifier: Apache-2.0
// The server's grid generator: its groups are opened to look at, change and save.
import {Missing} from '../page/alerts';
import {button, element, labelled, numberToSend, select} from '../page/dom';
import type {Viewer} from '../view/viewer';
import type {EditSession} from './edit_session';
import type {Groups} from './groups';
import {readGroups} from './stored_groups';

export class GridForm {
    readonly element: HTMLElement;
    private readonly mode = select([['regular', 'regular: a lattice'], ['layers', 'layers: above every floor'],
                                    ['surface', 'surface: on both sides of walls'],
                                    ['adaptive', 'adaptive: where light changes']], 'regular', () => {});
    private readonly spacing = element('input', {type: 'number', min: 0.05, step: 0.25, value: 2});
    private readonly most = element('input', {type: 'number', min: 1, step: 100, value: 5000});
    private readonly state = element('p', {class: 'facts', role: 'status'});
    private preview: Groups | null = null;
    private isGenerating = false;

    /** `open` is called with what was generated, and a name for it. */
    constructor(private readonly viewer: Viewer, private readonly session: EditSession,
                private readonly open: (generated: Groups, name: string) => void) {
        const generate = () => void viewer.alerts.attempt('generate', () => this.generate());
        this.element = element('div', {}, labelled('Mode', this.mode), labelled('Spacing, metres', this.spacing),
                               labelled('Maximum number of probes', this.most),
                               element('div', {class: 'buttons'}, button('Preview', generate)), this.state);
    }

    /** Says whether what is open is a preview. */
    show(): void {
        const isPreview = this.session.now.groups === this.preview && this.session.hasUnsavedGroups;
        this.state.textContent = this.isGenerating ? 'Generating…' :
            isPreview ? 'This is a preview: give it a name and save it, or open other groups.' : '';
    }

    private async generate(): Promise<void> {
        const {api, sceneFile} = this.viewer;
        if (sceneFile === null) throw new Missing('Open a scene first: the generator fills it with probes.');
        const order = {scene: sceneFile.id, mode: this.mode.value, spacing: numberToSend(this.spacing),
                       max_probes: numberToSend(this.most)};
        this.isGenerating = true;
        this.show();
        try {
            const {file, isNew} = await api.keep('/v1/grid', order);
            this.preview = await readGroups(api, file.id);
            if (isNew) await api.remove(`/v1/groups/${file.id}`);
            this.open(this.preview, `grid ${order.mode} ${order.spacing}`);
        } finally {
            this.isGenerating = false;
            this.show();
        }
    }
}
