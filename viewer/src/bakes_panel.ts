// SPDX-License-Identifier: Apache-2.0
// Bakes: a form with every setting, what runs and how far it is.
import {Bake, Unreachable} from './api';
import {BakeField, kBakeSections, valueOf} from './bake_fields';
import {formatCount, formatPercent, formatSeconds} from './colors';
import {button, element, labelled} from './dom';
import type {Viewer} from './viewer';

type Control = HTMLInputElement | HTMLSelectElement;

export class BakesPanel {
    readonly element: HTMLElement;
    private readonly fields = new Map<BakeField, Control>();
    private readonly name = element('input', {type: 'text', maxlength: 200});
    private readonly groups = element('select', {multiple: true, size: 4});
    private readonly onlyGiven = element('input', {type: 'checkbox'});
    private readonly list = element('ul', {class: 'bakes', 'aria-label': 'Bakes'});
    private readonly watched = new Set<string>();
    private readonly rates = new Map<string, {time: number; done: number}>();

    constructor(private readonly viewer: Viewer, private readonly finished: () => void) {
        const sections = kBakeSections.map(({title, fields}, i) => element(
            'details', {open: i === 0}, element('summary', {}, title),
            ...fields.map(field => labelled(field.label, this.control(field), `${field.hint} Default: ${field.default}.`))));
        const form = element(
            'form', {submit: (event: Event) => {
                event.preventDefault();
                void this.submit().catch(viewer.report);
            }},
            labelled('Name of the volume', this.name), labelled('Stored groups to add', this.groups),
            element('label', {class: 'check'}, this.onlyGiven, "Leave the scene's own groups out"),
            ...sections, element('div', {class: 'buttons'},
                                 element('button', {type: 'submit', class: 'main'}, 'Bake')));
        this.element = element('section', {'aria-label': 'Bakes'}, element('h2', {}, 'New bake'), form,
                               element('h2', {}, 'Bakes'), this.list);
    }

    /** What another panel saved is to be baked instead of the scene's own groups. */
    useGroups(id: string): void {
        void this.refresh().then(() => {
            for (const option of this.groups.options) option.selected = option.value === id;
            this.onlyGiven.checked = true;
        }).catch(this.viewer.report);
    }

    async refresh(): Promise<void> {
        const chosen = new Set([...this.groups.selectedOptions].map(option => option.value));
        const files = await this.viewer.api.list('groups');
        this.groups.replaceChildren(...files.map(file => {
            const option = element('option', {value: file.id}, file.name || file.id.slice(0, 8));
            option.selected = chosen.has(file.id);
            return option;
        }));
        const {bakes} = await this.viewer.api.get<{bakes: Bake[]}>('/v1/bakes');
        this.list.replaceChildren(...bakes.slice(0, 30).map(bake => this.row(bake)));
        if (bakes.length === 0) this.list.append(element('li', {class: 'hint'}, 'None yet.'));
        for (const bake of bakes) {
            if (bake.state === 'queued' || bake.state === 'running') void this.watch(bake.id);
        }
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
        if (viewer.sceneFile === null) throw new Error('Open a scene first: a bake needs one.');
        const order: Record<string, unknown> = {scene: viewer.sceneFile.id};
        if (this.name.value.trim() !== '') order.name = this.name.value.trim();
        const chosen = [...this.groups.selectedOptions].map(option => option.value);
        if (chosen.length > 0) order.groups = chosen;
        if (chosen.length > 0 && this.onlyGiven.checked) order.only_given_groups = true;
        for (const [field, control] of this.fields) {
            const value = valueOf(field, control.value);
            if (value !== undefined) order[field.key] = value;
        }
        const bake = await viewer.api.post<Bake>('/v1/bakes', order);
        viewer.say('The bake is accepted.');
        await this.refresh();
        void this.watch(bake.id);
    }

    private async watch(id: string): Promise<void> {
        if (this.watched.has(id)) return;
        this.watched.add(id);
        const abort = new AbortController();
        try {
            await this.viewer.api.watch(id, bake => this.update({...bake, id}), abort.signal);
        } catch (error) {
            if (!(error instanceof Unreachable)) this.viewer.report(error);
        } finally {
            this.watched.delete(id);
        }
    }

    private update(bake: Bake): void {
        const old = this.list.querySelector(`[data-bake="${bake.id}"]`);
        if (bake.state === 'deleted') old?.remove();
        else if (old !== null) old.replaceWith(this.row(bake));
        if (bake.state === 'done' && old?.getAttribute('data-state') !== 'done') {
            this.viewer.say(`The bake ${bake.name || bake.id} is done.`);
            if (old !== null) void this.viewer.openVolume(bake.volume!).catch(this.viewer.report);
            this.finished();
        }
    }

    private row(bake: Bake): HTMLElement {
        const row = element('li', {'data-bake': bake.id, 'data-state': bake.state},
                            element('strong', {}, bake.name || bake.id.slice(0, 8)), ` ${bake.state} `);
        const act = (text: string, work: () => Promise<unknown>) =>
            button(text, () => void work().then(() => this.refresh()).catch(this.viewer.report));
        if (bake.state === 'queued' || bake.state === 'running') {
            const bar = element('progress', {'aria-label': 'Progress', max: Math.max(1, bake.probe_count)});
            bar.value = bake.probes_done;
            row.append(bar, element('span', {class: 'facts'}, this.progress(bake)),
                       act('Cancel', () => this.viewer.api.post(`/v1/bakes/${bake.id}/cancel`, {})));
        } else {
            if (bake.volume !== undefined) row.append(act('Open', () => this.viewer.openVolume(bake.volume!)));
            row.append(act('Forget', () => this.viewer.api.remove(`/v1/bakes/${bake.id}`)));
        }
        if (bake.error) row.append(element('p', {class: 'error'}, bake.error));
        if (bake.report !== undefined) row.append(element('p', {class: 'facts'}, reportLine(bake.report)));
        return row;
    }

    /** "120 of 255 probes, 40 probes/s, 3 s left"; rays are counted when it is done. */
    private progress(bake: Bake): string {
        if (bake.probe_count === 0) return bake.state === 'queued' ? 'waits' : 'prepares';
        const words = [`${formatCount(bake.probes_done)} of ${formatCount(bake.probe_count)} probes`];
        const before = this.rates.get(bake.id);
        const now = performance.now() / 1000;
        if (before === undefined) this.rates.set(bake.id, {time: now, done: bake.probes_done});
        else if (now > before.time) words.push(`${Math.round((bake.probes_done - before.done) / (now - before.time))} probes/s`);
        if (bake.seconds_left !== undefined) words.push(`${formatSeconds(bake.seconds_left)} left`);
        return words.join(', ');
    }
}

function reportLine(report: Record<string, unknown>): string {
    const words: string[] = [];
    if (typeof report.probes === 'number') words.push(`${formatCount(report.probes)} probes`);
    if (typeof report.rays === 'number') words.push(`${formatCount(report.rays)} rays`);
    if (typeof report.rays_per_second === 'number') words.push(`${(report.rays_per_second / 1e6).toFixed(1)} million rays/s`);
    const error = report.standard_error as {median?: number; p99?: number} | null;
    if (error?.median !== undefined) words.push(`error ${formatPercent(error.median)} (median)`);
    for (const warning of (report.warnings ?? []) as string[]) words.push(warning);
    return words.join(', ');
}
