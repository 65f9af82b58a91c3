// SPDX-License-Identifier: Apache-2.0
// The page: a bar to choose scene and volume, the view, and tabs of controls.
import * as three from 'three';

import type {BakesPanel} from './bake/bakes_panel';
import {ComparePanel} from './compare/compare_panel';
import {Comparison} from './compare/comparison';
import type {LeakPanel} from './compare/leak_panel';
import type {EditPanel} from './edit/edit_panel';
import {InspectPanel} from './inspect/inspect_panel';
import {Alerts} from './page/alerts';
import {Api, messageOf, namesOf} from './page/api';
import {counted} from './page/colors';
import {button, element} from './page/dom';
import {download} from './page/download';
import {LatePart} from './page/late_part';
import {StatusLine} from './page/status_line';
import {Tabs} from './page/tabs';
import {TokenDialog} from './page/token_dialog';
import {fromLink} from './page/view_link';
import {viewTools} from './page/view_tools';
import {linkOf, openLink} from './page_link';
import {FileBar, StoredFiles} from './view/file_bar';
import {Pointer} from './view/pointer';
import {scenePanel} from './view/scene_panel';
import {Stage} from './view/stage';
import {Viewer} from './view/viewer';

const byId = (id: string) => document.getElementById(id)!;
const alerts = new Alerts(byId('banner'));

class Page {
    private readonly api: Api;
    readonly viewer: Viewer;
    readonly inspect: InspectPanel;
    readonly comparison: Comparison;
    private readonly compare: ComparePanel;
    readonly late = {
        edit: new LatePart(() => this.makeEdit()), leaks: new LatePart(() => this.makeLeaks()),
        bakes: new LatePart(() => this.makeBakes()), health: new LatePart(() => this.makeHealth()),
    };
    private readonly places = {edit: element('div'), leaks: element('div'), bakes: element('div'), health: element('div')};
    readonly tabs: Tabs;
    private readonly token = new TokenDialog(token => {
        this.api.token = token;
        void this.load();
    });
    private readonly status = new StatusLine(byId('status'), () => this.whatIsShown());
    private readonly files: FileBar;
    private readonly pointer: Pointer;
    private isLoaded = false;
    private link = fromLink(location.hash);

    constructor() {
        this.api = new Api({
            lost: () => {
                this.status.say('No connection.');
                alerts.show('The server does not answer. This page tries again every second.', 'connection');
            },
            found: () => {
                alerts.succeed('connection');
                this.status.tell('The server answers again.');
                void this.load();
                this.late.edit.value?.groups.editor.joined.askAgain();
            },
            unauthorized: () => {
                this.status.say('The server needs a token.');
                this.token.ask(this.api.token !== '');
            },
        });
        const stage = new Stage(byId('view'));
        this.viewer = new Viewer(this.api, stage, alerts, news => this.status.tell(news));
        this.inspect = new InspectPanel(this.viewer);
        this.comparison = new Comparison(this.viewer);
        this.compare = new ComparePanel(this.viewer, this.comparison, this.places.leaks);
        this.files = new FileBar(this.viewer, this.status, {
            listed: ({volumes, reflections}) => {
                this.viewer.reflections.setFiles(reflections);
                this.compare.setVolumes(volumes);
            },
            opened: () => this.followShown(),
            openGroups: async id => (await this.late.edit.get()).groups.open(id),
            openBakeTab: () => this.tabs.open('bake'),
        });
        this.pointer = new Pointer(stage);
        stage.parent.append(viewTools(stage.canvas, {
            frameSelection: () => this.tabs.current === 'edit' ? this.late.edit.value?.frame() : this.inspect.frame(),
            frameAll: () => stage.frame(this.viewer.box.getBoundingSphere(new three.Sphere()), 0.9),
            savePicture: () => stage.picture(picture => download(`${this.viewer.sceneFile?.name || 'tetralight'}.png`, picture, 'image/png')),
        }));
        this.tabs = new Tabs([
            {id: 'view', title: 'View', panel: scenePanel(this.viewer)},
            {id: 'inspect', title: 'Inspect', panel: this.inspect.element},
            {id: 'compare', title: 'Compare', panel: this.compare.element},
            {id: 'edit', title: 'Edit', panel: this.places.edit},
            {id: 'bake', title: 'Bake', panel: this.places.bakes},
            {id: 'health', title: 'Health', panel: this.places.health},
        ], 'inspect', id => this.openTab(id));
        byId('panel').append(this.tabs.element);
        byId('choose').append(...this.files.elements, button('Copy link', () => void this.copyLink()));
        this.followChanges();
        void this.api.attend();
    }

    /** The tab Edit has the view for itself. */
    private openTab(id: string): void {
        const isEdit = id === 'edit';
        const {edit, leaks, bakes, health} = this.late;
        if (isEdit) void alerts.attempt('open', () => edit.get());
        if (id === 'compare') void alerts.attempt('open', () => leaks.get());
        if (id === 'health') void alerts.attempt('open', () => health.get());
        this.pointer.use = isEdit ? edit.value?.pointer ?? {} : this.inspect.pointer;
        this.viewer.gizmo.detach();
        if (edit.value !== null) edit.value.isActive = isEdit;
        this.viewer.isEditing = isEdit;
        this.inspect.isActive = !isEdit;
        if (leaks.value !== null) leaks.value.isActive = id === 'compare';
        this.comparison.rest(isEdit);
        if (id === 'bake') void alerts.attempt('list', () => bakes.get().then(panel => panel.refresh()));
        if (id === 'compare') void alerts.attempt('list', () => this.compare.open());
        alerts.forgive();
    }

    private async makeEdit(): Promise<EditPanel> {
        const {EditPanel} = await import('./edit/edit_panel');
        const edit = new EditPanel(this.viewer, file => void alerts.attempt('list', async () => (await this.late.bakes.get()).useGroups(file.id)),
                                   () => void alerts.attempt('list', () => this.files.list().then(() => this.keepLink())));
        this.places.edit.append(edit.element);
        if (this.tabs.current === 'edit') {
            this.pointer.use = edit.pointer;
            edit.isActive = true;
        }
        return edit;
    }

    private async makeLeaks(): Promise<LeakPanel> {
        const {LeakPanel} = await import('./compare/leak_panel');
        const leaks = new LeakPanel(this.viewer, () => void this.comparison.set({mode: 'off'}));
        leaks.isActive = this.tabs.current === 'compare';
        this.places.leaks.append(leaks.element);
        return leaks;
    }

    private async makeBakes(): Promise<BakesPanel> {
        const {BakesPanel} = await import('./bake/bakes_panel');
        const bakes = new BakesPanel(this.viewer, {
            finished: () => void alerts.attempt('list', () => this.files.list()),
            openEditTab: () => this.tabs.open('edit'),
        });
        this.places.bakes.append(bakes.element);
        return bakes;
    }

    private async makeHealth(): Promise<HTMLElement> {
        const {healthPanel} = await import('./inspect/health_panel');
        const health = healthPanel(this.viewer);
        this.places.health.append(health);
        return health;
    }

    /** The address follows the page, and the page the address. */
    private followChanges(): void {
        const {stage} = this.viewer;
        stage.controls.addEventListener('end', () => this.keepLink());
        addEventListener('pagehide', () => this.keepLink());
        byId('panel').addEventListener('change', () => this.keepLink());
        stage.canvas.addEventListener('pointerup', () => setTimeout(() => this.keepLink()));
        addEventListener('hashchange', () => {
            if (location.hash === linkOf(this)) return;
            this.link = fromLink(location.hash);
            this.isLoaded = false;
            void this.load();
        });
        this.viewer.onChange(() => this.followShown());
        this.viewer.reflections.onChange(() => this.keepLink());
        this.comparison.onChange(() => this.keepLink());
    }

    /** Lists what there is; the first time, opens what the link says, or else the newest. */
    async load(): Promise<void> {
        await alerts.attempt('list', async () => {
            const listed = this.files.list();
            const opened = this.isLoaded ? null : this.viewer.stage.whileLoading(() => this.openLinked(listed));
            await Promise.all([listed, opened]);
            await Promise.all(Object.values(this.late).map(part => part.settled()));
            this.isLoaded = true;
            this.keepLink();
            const bakes = this.late.bakes.value;
            if (this.tabs.current === 'bake' || bakes?.hasWork) await bakes?.refresh();
            this.status.follow();
        });
        document.body.dataset.state = 'ready';
    }

    /** While the lists are on their way. */
    private openLinked(listed: Promise<StoredFiles>): Promise<void> {
        return openLink(this, this.link, {
            newest: async kind => (await listed)[kind].find(file => file.state === 'ready')?.id,
            way: {text: 'Open the newest', go: () => this.openNewest()},
        });
    }

    /** Without the link. */
    private openNewest(): void {
        this.link = {};
        this.isLoaded = false;
        void this.load();
    }

    /** All that names what is shown: both choices, the status line, the address. */
    private followShown(): void {
        this.files.follow();
        this.status.follow();
        this.keepLink();
    }

    private whatIsShown(): string {
        const {volume, sceneFile, bake} = this.viewer;
        const words = [sceneFile === null ? '' : namesOf(sceneFile),
                       volume === null ? '' : `${namesOf(volume.file)}: ${counted(volume.probes.probeCount, 'probe')}`,
                       volume !== null && sceneFile !== null && bake === null ? 'not known to be of this scene' : ''];
        return words.filter(word => word !== '').join(' · ') || 'Nothing is open.';
    }

    private keepLink(): void {
        if (this.isLoaded) history.replaceState(null, '', linkOf(this));
    }

    private async copyLink(): Promise<void> {
        this.keepLink();
        try {
            await navigator.clipboard.writeText(location.href);
            this.status.tell('The link is copied.');
        } catch {
            this.status.tell('The link is in the address bar.');
        }
    }
}

try {
    const page = new Page();
    Object.assign(window, {tetralight: page});  // for the console, tests and benchmarks
    void page.load();
} catch (error) {
    byId('status').textContent = 'The viewer cannot start.';
    alerts.show(`The viewer needs WebGL 2: ${messageOf(error)}`);
}
