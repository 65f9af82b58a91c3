// SPDX-License-Identifier: Apache-2.0
// The form of a new bake: what is baked, a preset, and every setting that the service accepts.
import {Missing} from '../page/alerts';
import {ApiError, Bake, isOfScene, titleOf} from '../page/api';
import {button, element, labelled, select} from '../page/dom';
import {ErrorWithWayOn} from '../page/gone';
import type {OpenApi} from '../page/open_api';
import type {Viewer} from '../view/viewer';
import {bakeSections, settingsOf, textOf} from './bake_fields';
import {LayerFields} from './bake_layers';
import {BakeKind, kOrders} from './bake_orders';
import {describe, fieldsOf, Preset} from './bake_presets';
import {SettingFields} from './setting_fields';

const kOnlyChangedHint = 'Probes whose position is unchanged keep the light of the open volume. ' +
    'Empty fields keep the settings of its bake; if any other setting differs, all probes are baked.';

export const kFormId = 'bake-form';

export class BakeForm {
    readonly element: HTMLElement;
    private readonly settings = new SettingFields(key => this.leavePreset(key));
    private readonly name = element('input', {type: 'text', maxlength: 200});
    private readonly groups = element('select', {multiple: true, size: 3});
    private readonly onlyGiven = element('input', {type: 'checkbox'});
    private readonly onlyChanged = element('input', {type: 'checkbox', change: () => this.takeEarlierSettings()});
    private readonly noGroups = element('p', {class: 'hint', hidden: true});
    private readonly layers = new LayerFields();
    private layeredScene: unknown;  // whose layers are shown
    private readonly kinds: HTMLSelectElement;
    private readonly preset: HTMLSelectElement;
    private readonly presetRow: HTMLElement;
    private readonly nameRow = labelled(kOrders.volumes.nameLabel, this.name);
    private readonly ofProbes = element('div');  // what only bakes of probes have
    private kind: BakeKind = 'volumes';
    private reusable = '';
    private offeredName = '';

    /** `openEditTab`: where probe groups are made. */
    constructor(private readonly viewer: Viewer, submit: () => void, private readonly openEditTab: () => void) {
        this.preset = select([['preview', 'Preview'], ['production', 'Production'], ['custom', 'Custom']], 'preview',
                             () => this.applyPreset());
        this.presetRow = labelled('Preset', this.preset, ' ');
        this.noGroups.append('This scene has no probe groups: ', button('generate some in the tab Edit', openEditTab, {class: 'link'}),
                             ', or choose stored groups below.');
        this.ofProbes.append(
            this.noGroups, this.layers.element,
            element('details', {}, element('summary', {}, 'Probe groups'),
                    labelled('Stored groups to add', this.groups),
                    element('label', {class: 'check'}, this.onlyGiven, "Omit the scene's own groups"),
                    element('label', {class: 'check', title: kOnlyChangedHint}, this.onlyChanged, 'Bake only what changed')));
        const kinds = (Object.keys(kOrders) as BakeKind[]).map(kind => [kind, kOrders[kind].title] as [string, string]);
        this.kinds = select(kinds, this.kind, kind => void viewer.alerts.attempt('bake', () => this.choose(kind as BakeKind)));
        this.element = element(
            'form', {id: kFormId, submit: (event: Event) => {
                event.preventDefault();
                submit();
            }},
            labelled('What to bake', this.kinds),
            this.presetRow, this.nameRow, this.ofProbes, this.settings.element);
        const offer = () => {
            this.offerReuse();
            this.offerName();
            this.offerLayers();
            this.followGroups();
        };
        viewer.onChange(offer);
        this.groups.addEventListener('change', () => this.followGroups());
        offer();
    }

    /** Orders the bake that the form describes. */
    async order(): Promise<Bake> {
        const {viewer, kind} = this;
        if (viewer.sceneFile === null) throw new Missing('Open a scene first: a bake needs one.');
        const order: Record<string, unknown> = {scene: viewer.sceneFile.id};
        this.name.removeAttribute('aria-invalid');
        if (kind === 'volumes') this.addProbes(order);
        if (this.name.value.trim() !== '') order.name = this.name.value.trim();
        this.settings.addTo(order);
        try {
            return await viewer.api.post<Bake>(kOrders[kind].path, order);
        } catch (error) {
            throw error instanceof ApiError ? this.marked(error) : error;
        }
    }

    /** Shows which field is wrong; the words then have its label. */
    private marked({status, code, message, field}: ApiError): ApiError {
        const isOfName = field === 'name';
        if (isOfName) {
            this.name.setAttribute('aria-invalid', 'true');
            this.name.focus();
        }
        const label = isOfName ? this.name.labels![0].textContent! : this.settings.mark(field);
        const isNamed = label !== undefined && message.startsWith(`${field}: `);
        return new ApiError(status, code, isNamed ? label + message.slice(field.length) : message, field);
    }

    /** Whether there is nothing to bake: no groups in the scene, and none chosen. */
    private get hasNoGroups(): boolean {
        const {sceneFile} = this.viewer;
        return sceneFile?.facts?.probe_groups === 0 && this.groups.selectedOptions.length === 0;
    }

    private followGroups(): void {
        this.noGroups.hidden = !this.hasNoGroups;
        if (this.hasNoGroups) this.groups.closest('details')!.open = true;
    }

    private addProbes(order: Record<string, unknown>): void {
        if (this.hasNoGroups) {
            throw new ErrorWithWayOn('The scene has no probe groups: generate some in the tab Edit, or choose stored groups.',
                                     {text: 'Open Edit', go: this.openEditTab});
        }
        if (this.onlyChanged.checked && this.earlier !== null) {
            Object.assign(order, settingsOf(this.settings.fields, this.earlier.request!),
                          {reuse: this.viewer.volume!.file.id});
        } else if (this.layers.chosen.length > 0) {
            order.layers = this.layers.chosen;
        }
        const chosen = [...this.groups.selectedOptions].map(option => option.value);
        if (chosen.length > 0) order.groups = chosen;
        if (chosen.length > 0 && this.onlyGiven.checked) order.only_given_groups = true;
    }

    /** The bake that made the open volume, if it was of the open scene. */
    private get earlier(): Bake | null {
        const {bake, volume, sceneFile} = this.viewer;
        return volume !== null && bake !== null && sceneFile !== null && isOfScene(bake, sceneFile) ? bake : null;
    }

    /** Enables "only what changed" if there is a bake to reuse. */
    private offerReuse(): void {
        const volume = this.earlier === null ? '' : this.viewer.volume!.file.id;
        if (volume !== this.reusable) this.onlyChanged.checked = false;
        this.onlyChanged.disabled = volume === '';
        this.reusable = volume;
    }

    /** Empty fields keep the settings of the earlier bake, which a preset would change. */
    private takeEarlierSettings(): void {
        if (!this.onlyChanged.checked) return;
        this.settings.fill(() => '');
        this.preset.value = 'custom';
        this.applyPreset();
    }

    /** Offers the scene's name, unless the user typed another. */
    private offerName(): void {
        if (this.name.value !== this.offeredName) return;
        this.offeredName = this.viewer.sceneFile?.name ?? '';
        this.name.value = this.offeredName;
    }

    private offerLayers(): void {
        const {sceneFile, model} = this.viewer;
        const scene = sceneFile?.id ?? '';
        if (scene === this.layeredScene) return;
        this.layeredScene = scene;
        this.layers.follow(model);
        this.groups.selectedIndex = -1;  // chosen for the previous scene
        this.onlyGiven.checked = false;
    }

    /** Selects stored groups instead of the scene's own. */
    async useGroups(id: string): Promise<void> {
        await this.refresh();
        for (const option of this.groups.options) option.selected = option.value === id;
        this.groups.closest('details')!.open = true;
        this.onlyGiven.checked = true;
        this.onlyChanged.checked = this.earlier !== null;
        this.takeEarlierSettings();
        this.followGroups();
    }

    /** Fills the form with the order of an earlier bake. */
    async take({kind, name, request = {}}: Bake): Promise<void> {
        await this.choose(kind);
        this.preset.value = 'custom';
        this.applyPreset();
        this.name.value = name;
        this.settings.fill(key => textOf(request[key]));
        this.takeLayers((request.layers ?? []) as string[]);
        const groups = (request.groups ?? []) as string[];
        for (const option of this.groups.options) option.selected = groups.includes(option.value);
        this.onlyGiven.checked = request.only_given_groups === true;
        this.onlyChanged.checked = false;
        this.followGroups();
        this.element.scrollIntoView({block: 'start'});
        this.preset.focus();
    }

    /** The field takes them all if one of them has no box. */
    private takeLayers(layers: readonly string[]): void {
        if (this.kind !== 'volumes') return;
        this.layers.choose(layers);
        if (layers.every(layer => this.layers.has(layer))) this.settings.fill(key => key === 'layers' ? '' : undefined);
    }

    private async choose(kind: BakeKind): Promise<void> {
        this.kind = kind;
        this.kinds.value = kind;
        this.nameRow.querySelector('label')!.textContent = kOrders[kind].nameLabel;
        this.ofProbes.hidden = kind !== 'volumes';
        this.settings.clear();
        await this.makeFields();
    }

    /** Makes a field of each setting that the service accepts. */
    private async makeFields(): Promise<void> {
        const {kind} = this;
        const sections = bakeSections(await this.viewer.api.get<OpenApi>('/openapi.json'), kOrders[kind].schema);
        if (this.settings.fields.length > 0 || kind !== this.kind) return;
        this.settings.make(sections);
        this.applyPreset();
    }

    private applyPreset(): void {
        const preset = this.preset.value as Preset;
        this.presetRow.querySelector('small')!.textContent =
            describe(this.kind, preset, new Map(this.settings.fields.map(field => [field.key, field.default])));
        if (preset === 'custom') {
            this.settings.openFirstSections();
            return;
        }
        const values = fieldsOf(this.kind, preset);
        const ofPresets = Object.keys(fieldsOf(this.kind, 'preview'));
        this.settings.fill(key => ofPresets.includes(key) ? values[key] ?? '' : undefined);
    }

    /** A setting that a preset fills was changed by hand. */
    private leavePreset(key: string): void {
        if (!(key in fieldsOf(this.kind, 'preview'))) return;
        this.preset.value = 'custom';
        this.applyPreset();
    }

    /** Reads the fields of the service, the first time, and the stored groups. */
    async refresh(): Promise<void> {
        if (this.settings.fields.length === 0) await this.makeFields();
        const chosen = new Set([...this.groups.selectedOptions].map(option => option.value));
        const files = await this.viewer.api.list('groups');
        this.groups.replaceChildren(...files.map(file => {
            const option = element('option', {value: file.id}, titleOf(file));
            option.selected = chosen.has(file.id);
            return option;
        }));
        this.followGroups();
    }
}
