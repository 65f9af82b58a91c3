// SPDX-License-Identifier: Apache-2.0
// Bakes: a form with every setting, and the bakes with their progress.
import {Missing} from './alerts';
import {ApiError, Bake, titleOf} from './api';
import {BakeField, bakeSections, OpenApi, settingsOf, valueOf} from './bake_fields';
import {countsOf, formatRate, progressOf} from './bake_progress';
import {counted, formatCount, formatPercent} from './colors';
import {button, element, labelled, select} from './dom';
import {Newest} from './newest';
import type {Viewer} from './viewer';

const kOnlyChangedHint = 'Probes whose position is unchanged keep the light of the open volume. ' +
    'Empty fields keep the settings of its bake; if any other setting differs, all probes are baked.';

type Control = HTMLInputElement | HTMLSelectElement;

type Result = 'volumes' | 'lightmaps';

/** Of a result: where it is ordered, the schema of the order, and the label of its name. */
const kOrders: Record<Result, {path: string; schema: string; label: string}> = {
    volumes: {path: '/v1/bakes', schema: 'BakeOrder', label: 'Name of the volume'},
    lightmaps: {path: '/v1/lightmap-bakes', schema: 'LightmapBakeOrder', label: 'Name of the lightmaps'},
};

export class BakesPanel {
    readonly element: HTMLElement;
    private readonly fields = new Map<BakeField, Control>();
    private readonly sections = element('div');
    private readonly name = element('input', {type: 'text', maxlength: 200});
    private readonly groups = element('select', {multiple: true, size: 4});
    private readonly onlyGiven = element('input', {type: 'checkbox'});
    private readonly onlyChanged = element('input', {type: 'checkbox'});
    private readonly list = element('ul', {class: 'bakes', 'aria-label': 'Bakes'});
    private reusable = '';
    private offeredName = '';
    private result: Result = 'volumes';
    private readonly nameRow = labelled(kOrders.volumes.label, this.name);
    private readonly ofProbes = element('div');  // what only bakes of probes have
    private readonly scenes = new Map<string, string>();  // of the bakes in the list
    private watched = {bake: '', preview: 0};  // whose previews are shown
    private readonly previews = new Newest<string, void>(
        bake => this.viewer.showPreview(bake, this.scenes.get(bake)!), () => {}, error => this.missPreview(error));
    private stream: AbortController | null = null;

    constructor(private readonly viewer: Viewer, private readonly finished: () => void) {
        const form = element(
            'form', {submit: (event: Event) => {
                event.preventDefault();
                void viewer.alerts.attempt('bake', () => this.submit());
            }},
            labelled('Bake', select([['volumes', 'Probes'], ['lightmaps', 'Lightmaps']], this.result,
                                    result => void viewer.alerts.attempt('bake', () => this.choose(result as Result)))),
            this.nameRow, this.ofProbes, this.sections, element('div', {class: 'buttons'},
                                   element('button', {type: 'submit', class: 'main'}, 'Bake')));
        this.ofProbes.append(
            labelled('Stored groups to add', this.groups),
            element('label', {class: 'check'}, this.onlyGiven, "Omit the scene's own groups"),
            element('label', {class: 'check', title: kOnlyChangedHint}, this.onlyChanged, 'Bake only what changed'));
        this.element = element('section', {'aria-label': 'Bakes'}, element('h2', {}, 'New bake'), form,
                               element('h2', {}, 'Bakes'), this.list);
        viewer.onChange(() => {
            this.offerReuse();
            this.offerName();
        });
        this.offerReuse();
    }

    /** The bake that made the open volume, if it was of the open scene. */
    private get earlier(): Bake | null {
        const {bake, volume, sceneFile} = this.viewer;
        const scene = bake?.request?.scene;
        const isOfScene = sceneFile !== null && (scene === sceneFile.id || sceneFile.names.includes(scene as string));
        return volume !== null && isOfScene ? bake : null;
    }

    /** Enables "only what changed" if there is a bake to reuse. */
    private offerReuse(): void {
        const volume = this.earlier === null ? '' : this.viewer.volume!.file.id;
        if (volume !== this.reusable) this.onlyChanged.checked = false;
        this.onlyChanged.disabled = volume === '';
        this.reusable = volume;
    }

    /** Offers the scene's name, unless the user typed another. */
    private offerName(): void {
        if (this.name.value !== this.offeredName) return;
        this.offeredName = this.viewer.sceneFile?.name ?? '';
        this.name.value = this.offeredName;
    }

    /** Selects groups that another panel saved, instead of the scene's own. */
    useGroups(id: string): void {
        void this.viewer.alerts.attempt('list', async () => {
            await this.refresh();
            for (const option of this.groups.options) option.selected = option.value === id;
            this.onlyGiven.checked = true;
            this.onlyChanged.checked = this.earlier !== null;
        });
    }

    /** Shows the form for probes or lightmaps. */
    private async choose(result: Result): Promise<void> {
        this.result = result;
        this.nameRow.querySelector('label')!.textContent = kOrders[result].label;
        this.ofProbes.hidden = result !== 'volumes';
        this.fields.clear();
        this.sections.replaceChildren();
        await this.makeFields();
    }

    /** Makes a field of each setting that the service accepts. */
    private async makeFields(): Promise<void> {
        const {result} = this;
        const sections = bakeSections(await this.viewer.api.get<OpenApi>('/openapi.json'), kOrders[result].schema);
        if (this.fields.size > 0 || result !== this.result) return;
        this.sections.replaceChildren(...sections.map(({title, isOpen, fields}) => element(
            'details', {open: isOpen}, element('summary', {}, title),
            ...fields.map(field => labelled(field.label, this.control(field),
                                            `${field.hint} Default: ${field.default}.`)))));
    }

    async refresh(): Promise<void> {
        if (this.fields.size === 0) await this.makeFields();
        const chosen = new Set([...this.groups.selectedOptions].map(option => option.value));
        const files = await this.viewer.api.list('groups');
        this.groups.replaceChildren(...files.map(file => {
            const option = element('option', {value: file.id}, titleOf(file));
            option.selected = chosen.has(file.id);
            return option;
        }));
        const {bakes} = await this.viewer.api.get<{bakes: Bake[]}>('/v1/bakes');
        for (const {id, request} of bakes) this.scenes.set(id, String(request?.scene));
        this.keepFocus(() => this.list.replaceChildren(...bakes.slice(0, 30).map(bake => this.row(bake))));
        if (bakes.length === 0) this.list.append(element('li', {class: 'hint'}, 'None yet.'));
        if (bakes.some(isUnderWay)) void this.watch();
    }

    private control(field: BakeField): Control {
        let made: Control;
        if (field.kind === 'choice' || field.kind === 'flag') {
            const options = field.kind === 'flag' ? ['true'] : field.options!;
            made = element('select', {}, element('option', {value: ''}, `default (${field.default})`),
                           ...options.map(option => element('option', {value: option}, option === 'true' ? 'yes' : option)));
        } else {
            made = element('input', {type: 'text', placeholder: field.default, autocomplete: 'off',
                                     inputmode: field.kind === 'number' || field.kind === 'integer' ? 'decimal' : 'text'});
        }
        made.name = field.key;
        this.fields.set(field, made);
        return made;
    }

    private async submit(): Promise<void> {
        const {viewer} = this;
        if (viewer.sceneFile === null) throw new Missing('Open a scene first: a bake needs one.');
        const order: Record<string, unknown> = {scene: viewer.sceneFile.id};
        const isOfProbes = this.result === 'volumes';
        if (isOfProbes && this.onlyChanged.checked && this.earlier !== null) {
            Object.assign(order, settingsOf(this.fields.keys(), this.earlier.request!), {reuse: this.viewer.volume!.file.id});
        }
        if (this.name.value.trim() !== '') order.name = this.name.value.trim();
        const chosen = isOfProbes ? [...this.groups.selectedOptions].map(option => option.value) : [];
        if (chosen.length > 0) order.groups = chosen;
        if (chosen.length > 0 && this.onlyGiven.checked) order.only_given_groups = true;
        for (const [field, control] of this.fields) {
            const value = this.marked(field, () => valueOf(field, control.value));
            if (value !== undefined) order[field.key] = value;
        }
        const {id} = await this.ordered(order);
        if (!isOfProbes) this.watchPreviews(id);
        viewer.say('The bake is accepted.');
        await this.refresh();
    }

    private async ordered(order: Record<string, unknown>): Promise<Bake> {
        try {
            return await this.viewer.api.post<Bake>(kOrders[this.result].path, order);
        } catch (error) {
            const wrong = [...this.fields.keys()].find(({key}) => error instanceof ApiError && error.field === key);
            if (wrong !== undefined) this.mark(wrong);
            throw error;
        }
    }

    private marked(field: BakeField, read: () => unknown): unknown {
        this.fields.get(field)!.removeAttribute('aria-invalid');
        try {
            return read();
        } catch (error) {
            this.mark(field);
            throw error;
        }
    }

    private mark(field: BakeField): void {
        const control = this.fields.get(field)!;
        control.setAttribute('aria-invalid', 'true');
        control.closest('details')!.open = true;
        control.focus();
    }

    /** Follows all bakes while one of them is under way. */
    private async watch(): Promise<void> {
        if (this.stream !== null) return;
        const stream = new AbortController();
        this.stream = stream;
        try {
            await this.viewer.api.watchBakes(bake => this.update(bake), stream.signal);
        } catch (error) {
            if (!stream.signal.aborted) this.viewer.alerts.report('watch', error);
        } finally {
            if (this.stream === stream) this.stream = null;
        }
    }

    private stopIfAllHaveEnded(): void {
        if (this.list.querySelector('[data-state="queued"], [data-state="running"]') !== null) return;
        this.stream?.abort();
        this.stream = null;
    }

    private update(bake: Bake): void {
        const old = this.list.querySelector<HTMLElement>(`[data-bake="${bake.id}"]`);
        if (bake.state === 'deleted') old?.remove();
        else if (old?.dataset.state === bake.state && isUnderWay(bake)) this.showProgress(old, bake);
        else if (old !== null) this.keepFocus(() => old.replaceWith(this.row(bake)));
        this.followPreview(bake);
        if (bake.state === 'done' && old?.dataset.state !== 'done') {
            this.viewer.say(`The bake ${bake.name || bake.id} is done.`);
            if (old !== null) void this.viewer.alerts.attempt('open', () => this.open(bake));
            this.finished();
        }
        if (!isUnderWay(bake)) this.stopIfAllHaveEnded();
    }

    private open(bake: Bake): Promise<void> {
        if (bake.kind === 'volumes') return this.viewer.openVolume(bake.volume!);
        if (bake.kind === 'reflections') return this.viewer.openReflections(bake.reflections!);
        this.previews.forget();
        return this.viewer.openLightmaps(bake.lightmaps!, this.scenes.get(bake.id)!, bake.id);
    }

    /** Shows previews of a bake of lightmaps on its scene, from now on. */
    private watchPreviews(bake: string): void {
        this.watched = {bake, preview: 0};
    }

    private followPreview({id, preview, state}: Bake): void {
        if (id !== this.watched.bake || state !== 'running' || typeof preview !== 'number') return;
        if (preview === this.watched.preview || !this.scenes.has(id)) return;
        this.watched.preview = preview;
        this.previews.ask(id);
    }

    /** A bake may end while its preview is asked for. */
    private missPreview(error: unknown): void {
        if (!(error instanceof ApiError && error.status === 404)) this.viewer.alerts.report('preview', error);
    }

    /** Rebuilds rows; the focus stays with its bake. */
    private keepFocus(change: () => void): void {
        const focused = document.activeElement;
        const id = this.list.contains(focused) ? focused!.closest('li')!.dataset.bake : undefined;
        change();
        const buttons = [...this.list.querySelectorAll<HTMLElement>(`[data-bake="${id}"] button`)];
        (buttons.find(({textContent}) => textContent === focused!.textContent) ?? buttons[0])?.focus();
    }

    private row(bake: Bake): HTMLElement {
        const row = element('li', {'data-bake': bake.id, 'data-state': bake.state},
                            element('strong', {}, titleOf(bake)), ` ${bake.state} `);
        const act = (text: string, work: () => Promise<unknown>) =>
            button(text, () => void this.viewer.alerts.attempt(text, () => work().then(() => this.refresh())));
        if (isUnderWay(bake)) {
            row.append(element('progress', {'aria-label': 'Progress'}), element('span', {class: 'facts'}),
                       ...bake.kind !== 'lightmaps' ? [] : [act('Show', async () => this.watchPreviews(bake.id))],
                       act('Cancel', () => this.viewer.api.request('POST', `/v1/bakes/${bake.id}/cancel`)));
            this.showProgress(row, bake);
        } else {
            if (bake.state === 'done') row.append(act('Open', () => this.open(bake)));
            row.append(act('Forget', () => this.viewer.api.remove(`/v1/bakes/${bake.id}`)));
        }
        if (bake.error) row.append(element('p', {class: 'error'}, bake.error));
        if (bake.report !== undefined) row.append(element('p', {class: 'facts'}, reportLine(bake.report)));
        return row;
    }

    private showProgress(row: HTMLElement, bake: Bake): void {
        const bar = row.querySelector('progress')!;
        const {done, count} = countsOf(bake);
        bar.max = Math.max(1, count);
        bar.value = done;
        row.querySelector('.facts')!.textContent = progressOf(bake);
    }
}

const isUnderWay = ({state}: Bake) => state === 'queued' || state === 'running';

function reportLine(report: Record<string, unknown>): string {
    const words: string[] = [];
    if (typeof report.probes === 'number') words.push(counted(report.probes, 'probe'));
    if (typeof report.baked === 'number') words.push(counted(report.baked, 'texel'));
    if (typeof report.pages === 'number') words.push(counted(report.pages, 'page'));
    if (typeof report.reused === 'number' && report.reused > 0) words.push(`${formatCount(report.reused)} reused`);
    if (typeof report.rays === 'number') words.push(`${formatCount(report.rays)} rays`);
    if (typeof report.rays_per_second === 'number') words.push(formatRate(report.rays_per_second));
    const error = report.standard_error as {median?: number; p99?: number} | null;
    if (error?.median !== undefined) words.push(`error ${formatPercent(error.median)} (median)`);
    for (const warning of (report.warnings ?? []) as string[]) words.push(warning.replace(/^reuse: /, ''));
    return words.join(', ');
}
