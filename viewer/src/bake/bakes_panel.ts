// SPDX-License-Identifier: Apache-2.0
// The tab Bake: a form, the bar that orders a bake and shows how far it is, and all bakes.
import {ApiError, Bake, isOfScene, titleOf} from '../page/api';
import {button, element} from '../page/dom';
import {Newest} from '../page/newest';
import type {Viewer} from '../view/viewer';
import {BakeBar} from './bake_bar';
import {BakeForm, kFormId} from './bake_form';
import {kOrders} from './bake_orders';
import {countsOf, isUnderWay, progressOf, reportLine} from './bake_progress';
import {explain, explainOrder, kAfterFailure} from './bake_words';
import {showPages} from './lightmap_pages';

export interface BakeActions {
    /** Called when a bake has ended well. */
    finished(): void;
    openEditTab(): void;
}

export class BakesPanel {
    readonly element: HTMLElement;
    private readonly form: BakeForm;
    private readonly bar: BakeBar;
    private readonly list = element('ul', {class: 'bakes', 'aria-label': 'Bakes'});
    private readonly bakes = new Map<string, Bake>();  // in the list
    private watched = {bake: '', preview: 0, before: ''};  // whose previews are shown, and the volume that was open
    private readonly previews = new Newest<string, () => void | Promise<void>>(
        bake => this.viewer.open.preview(this.bakes.get(bake)!),
        show => void this.viewer.alerts.attempt('preview', () => this.withExposure(show)), error => this.missPreview(error));
    private stream: AbortController | null = null;

    constructor(private readonly viewer: Viewer, private readonly actions: BakeActions) {
        this.form = new BakeForm(viewer, () => void viewer.alerts.attempt('bake', () => this.submit()), actions.openEditTab);
        this.bar = new BakeBar(kFormId, bake => this.act(this.bakes.get(bake)!, () => this.cancel(bake)));
        const pages = element('div', {class: 'pages'});
        const ofPages = element('div', {hidden: true}, element('h2', {}, 'Pages of the lightmaps'), pages);
        const show = () => {
            ofPages.hidden = viewer.lightmaps === null;
            showPages(pages, viewer.lightmaps);
        };
        viewer.onPages(show);
        show();
        this.element = element('section', {'aria-label': 'Bakes'}, element('h2', {}, 'New bake'), this.form.element,
                               element('h2', {}, 'Bakes'), this.list, ofPages, this.bar.element);
    }

    /** Selects groups that another panel saved, instead of the scene's own. */
    useGroups(id: string): void {
        void this.viewer.alerts.attempt('list', () => this.form.useGroups(id));
    }

    async refresh(): Promise<void> {
        await this.form.refresh();
        const {bakes} = await this.viewer.api.get<{bakes: Bake[]}>('/v1/bakes');
        this.bakes.clear();
        for (const bake of bakes) this.bakes.set(bake.id, bake);
        this.keepFocus(() => this.list.replaceChildren(...bakes.slice(0, 30).map(bake => this.row(bake))));
        if (bakes.length === 0) this.list.append(element('li', {class: 'hint'}, 'None yet.'));
        this.bar.show([...this.bakes.values()]);
        if (this.hasWork) void this.watch();
    }

    /** A bake that the page knows is under way; the stream of its events may have ended with the server. */
    get hasWork(): boolean {
        return [...this.bakes.values()].some(isUnderWay);
    }

    private async submit(): Promise<void> {
        const {id} = await this.form.order().catch(error => { throw explainOrder(error); });
        this.watchPreviews(id);
        this.viewer.say('The bake is accepted.');
        await this.refresh();
    }

    private async cancel(bake: string): Promise<void> {
        await this.viewer.api.request('POST', `/v1/bakes/${bake}/cancel`);
    }

    /** Does something with a bake; what was shown of it may be out of date, so the list is read again. */
    private act(bake: Bake, work: () => Promise<unknown>): void {
        const explained = () => work().catch(error => { throw explain(error, bake); });
        void this.viewer.alerts.attempt('of a bake', () => explained().finally(() => this.refresh()));
    }

    /** Fills the form with the settings of a bake, on its scene. */
    private async takeSettings(bake: Bake): Promise<void> {
        try {
            await this.openSceneOf(bake);
        } finally {
            await this.form.take(bake);
        }
    }

    private async openSceneOf(bake: Bake): Promise<void> {
        const scene = bake.request?.scene as string | undefined;
        if (scene !== undefined && !this.isOfOpenScene(bake)) await this.viewer.open.scene(scene);
    }

    private isOfOpenScene(bake: Bake): boolean {
        const {sceneFile} = this.viewer;
        return sceneFile !== null && isOfScene(bake, sceneFile);
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
        if (this.hasWork) return;
        this.stream?.abort();
        this.stream = null;
    }

    private update(bake: Bake): void {
        const old = this.list.querySelector<HTMLElement>(`[data-bake="${bake.id}"]`);
        const request = this.bakes.get(bake.id)?.request;  // events leave it out
        if (old === null && request === undefined && isUnderWay(bake)) return void this.viewer.alerts.attempt('list', () => this.refresh());
        if (bake.state === 'deleted') this.bakes.delete(bake.id);
        else this.bakes.set(bake.id, {...bake, request: bake.request ?? request});
        if (bake.state === 'deleted') old?.remove();
        else if (old?.dataset.state === bake.state && isUnderWay(bake)) this.showProgress(old, bake);
        else if (old !== null) this.keepFocus(() => old.replaceWith(this.row(bake)));
        this.bar.show([...this.bakes.values()]);
        this.followPreview(bake);
        if (bake.id === this.watched.bake && ['cancelled', 'failed', 'deleted'].includes(bake.state)) {
            void this.viewer.alerts.attempt('open', () => this.leavePreview());
        }
        if (bake.state === 'done' && old?.dataset.state !== 'done') {
            this.viewer.say(`The bake ${titleOf(bake)} is done.`);
            const ended = this.bakes.get(bake.id)!;
            if (old !== null && (this.isOfOpenScene(ended) || this.viewer.sceneFile === null)) this.act(ended, () => this.open(bake));
            this.actions.finished();
        }
        if (!isUnderWay(bake)) this.stopIfAllHaveEnded();
    }

    private open(bake: Bake): Promise<void> {
        this.previews.forget();
        if (bake.kind === 'volumes') return this.withExposure(() => this.viewer.open.volume(bake.volume!));
        if (bake.kind === 'reflections') return this.viewer.open.reflections(bake.reflections!);
        const scene = String(this.bakes.get(bake.id)?.request?.scene);
        return this.viewer.open.lightmaps(bake.lightmaps!, scene, bake.id);
    }

    /** Shows light; a view that had none is metered again. */
    private async withExposure(show: () => void | Promise<void>): Promise<void> {
        const {viewer} = this;
        const hadNone = viewer.volume === null || viewer.volume.probes.probeCount === 0;
        await show();
        if (hadNone && viewer.volume !== null) await viewer.stage.exposeItself();
    }

    private async showPreviews(bake: Bake): Promise<void> {
        await this.openSceneOf(this.bakes.get(bake.id)!);
        this.watchPreviews(bake.id);
    }

    /** Shows previews of a bake, from now on, while its scene is open. */
    private watchPreviews(bake: string): void {
        this.watched = {bake, preview: 0, before: this.viewer.volume?.file.id || this.watched.before};
    }

    /** A bake ended without a volume: the one that was open before returns. */
    private async leavePreview(): Promise<void> {
        this.previews.forget();
        const {before} = this.watched;
        if (this.viewer.volume?.file.id !== '') return;
        if (before !== '') await this.viewer.open.volume(before);
        else this.viewer.say('The light so far stays in view; it is not stored.');
    }

    private followPreview({id, preview, state}: Bake): void {
        if (id !== this.watched.bake || state !== 'running' || typeof preview !== 'number') return;
        if (preview === this.watched.preview || !this.isOfOpenScene(this.bakes.get(id)!)) return;
        this.watched.preview = preview;
        this.previews.ask(id);
    }

    /** A bake may end while its preview is asked for. */
    private missPreview(error: unknown): void {
        const bake = this.bakes.get(this.watched.bake);
        const isOver = error instanceof ApiError && error.status === 404 && error.field !== 'scene';
        if (!isOver && bake !== undefined) this.viewer.alerts.report('preview', explain(error, bake));
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
                            element('strong', {}, titleOf(bake)), ` ${bake.state} `,
                            element('span', {class: 'hint'}, kOrders[bake.kind].title.toLowerCase()), ' ');
        const act = (text: string, work: () => Promise<unknown>) => button(text, () => this.act(bake, work));
        if (isUnderWay(bake)) {
            row.append(element('progress', {'aria-label': 'Progress'}), element('span', {class: 'facts'}),
                       ...bake.kind === 'reflections' ? [] : [act('Show', () => this.showPreviews(bake))],
                       act('Cancel', () => this.cancel(bake.id)));
            this.showProgress(row, bake);
        } else {
            if (bake.state === 'done') row.append(act('Open', () => this.open(bake)));
            if (bake.request !== undefined) row.append(act('Use its settings', () => this.takeSettings(bake)));
            row.append(act('Forget', () => this.viewer.api.remove(`/v1/bakes/${bake.id}`)));
        }
        if (bake.error) row.append(element('p', {class: 'error'}, bake.error), element('p', {class: 'hint'}, kAfterFailure));
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
