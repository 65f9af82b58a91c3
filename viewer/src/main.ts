// SPDX-License-Identifier: Apache-2.0
// The page: a bar to choose scene and volume, the view, and tabs of controls.
import * as three from 'three';

import {Alerts} from './alerts';
import {Api, Kind, messageOf, StoredFile, titleOf, Unreachable} from './api';
import {BakesPanel} from './bakes_panel';
import {counted} from './colors';
import {button, element} from './dom';
import {GroupsPanel} from './groups_panel';
import {healthPanel} from './health_panel';
import {Pointer} from './pointer';
import {QueryPanel} from './query_panel';
import {scenePanel} from './scene_panel';
import {Stage} from './stage';
import {StatusLine} from './status_line';
import {Tabs} from './tabs';
import {TokenDialog} from './token_dialog';
import {fromLink, toLink} from './view_link';
import {Part, ProbeColor, Viewer} from './viewer';

const byId = (id: string) => document.getElementById(id)!;
const alerts = new Alerts(byId('banner'));

class Page {
    private readonly api: Api;
    readonly viewer: Viewer;
    readonly query: QueryPanel;
    readonly groups: GroupsPanel;
    private readonly bakes: BakesPanel;
    private readonly tabs: Tabs;
    private readonly token = new TokenDialog(token => {
        this.api.token = token;
        void this.load();
    });
    private readonly scenes = element('select', {'aria-label': 'Scene', change: () => this.choose('scenes')});
    private readonly volumes = element('select', {'aria-label': 'Probe volume', change: () => this.choose('volumes')});
    private readonly next = element('p', {class: 'next', hidden: true}, 'No volume yet: ',
                                    button('bake one', () => this.tabs.open('bakes'), {class: 'link'}));
    private readonly empty = element('div', {class: 'empty', hidden: true});
    private readonly status = new StatusLine(byId('status'), () => this.whatIsShown());
    private isLoaded = false;
    private link = fromLink(location.hash);

    constructor() {
        this.api = new Api({
            lost: () => {
                this.status.say('No connection.');
                alerts.show('The server does not answer. This page tries again every second.');
            },
            found: () => {
                alerts.clear();
                this.status.tell('The server answers again.');
                void this.load();
                this.groups.editor.askAgain();
            },
            unauthorized: () => {
                this.status.say('The server needs a token.');
                this.token.ask(this.api.token !== '');
            },
        });
        const stage = new Stage(byId('view'));
        stage.parent.append(this.empty, this.next);
        this.viewer = new Viewer(this.api, stage, alerts, news => this.status.tell(news));
        this.query = new QueryPanel(this.viewer);
        this.bakes = new BakesPanel(this.viewer, () => void alerts.attempt('list', () => this.list()));
        this.groups = new GroupsPanel(this.viewer, file => this.bakes.useGroups(file.id));
        const pointer = new Pointer(stage);
        this.tabs = new Tabs([
            {id: 'view', title: 'View', panel: scenePanel(this.viewer)},
            {id: 'query', title: 'Query', panel: this.query.element},
            {id: 'groups', title: 'Probes', panel: this.groups.element},
            {id: 'bakes', title: 'Bakes', panel: this.bakes.element},
            {id: 'health', title: 'Health', panel: healthPanel(this.viewer)},
        ], id => {
            pointer.use = id === 'groups' ? this.groups.pointer : this.query.pointer;
            this.viewer.gizmo.detach();
            this.groups.isActive = id === 'groups';
            this.viewer.isEditing = id === 'groups';
            if (id === 'bakes') void alerts.attempt('list', () => this.bakes.refresh());
            alerts.forgive();
        });
        byId('panel').append(this.tabs.element);
        byId('choose').append(this.scenes, this.volumes, this.uploadButton(),
                              button('Copy link', () => void this.copyLink()));
        stage.controls.addEventListener('end', () => this.keepLink());
        addEventListener('pagehide', () => this.keepLink());
        byId('panel').addEventListener('change', () => this.keepLink());
        stage.canvas.addEventListener('pointerup', () => setTimeout(() => this.keepLink()));
        addEventListener('hashchange', () => {
            if (location.hash === this.linkNow()) return;
            this.link = fromLink(location.hash);
            this.isLoaded = false;
            void this.load();
        });
        this.acceptDrops(stage.parent);
        this.viewer.onChange(() => this.followShown());
        this.viewer.onReflections(() => this.keepLink());
        void this.api.attend();
    }

    /** Lists what there is; the first time, opens what the link says, or else the newest. */
    async load(): Promise<void> {
        await alerts.attempt('list', async () => {
            const [scenes, volumes] = await this.list();
            if (!this.isLoaded) await this.openLinked(scenes, volumes);
            this.isLoaded = true;
            this.keepLink();
            if (this.tabs.current === 'bakes') await this.bakes.refresh();
            this.status.sayState();
        });
        document.body.dataset.state = 'ready';
    }

    private async list(): Promise<[StoredFile[], StoredFile[]]> {
        const [scenes, volumes, reflections] = await Promise.all(
            [this.api.list('scenes'), this.api.list('volumes'), this.api.list('reflections')]);
        fill(this.scenes, 'Scene…', scenes);
        fill(this.volumes, 'Volume…', volumes);
        this.selectShown();
        this.viewer.setReflectionFiles(reflections);
        this.showEmpty(scenes.length, volumes.length);
        return [scenes, volumes];
    }

    private async openLinked(scenes: StoredFile[], volumes: StoredFile[]): Promise<void> {
        const {link, viewer} = this;
        const ready = (files: StoredFile[]) => files.find(file => file.state === 'ready')?.id;
        for (const part of link.hidden ?? []) viewer.show(part as Part, false);
        if (link.color !== undefined) viewer.color = link.color as ProbeColor;
        const volume = link.volume ?? ready(volumes);
        if (volume !== undefined) await alerts.attempt('open', () => viewer.openVolume(volume, link.weights));
        const scene = link.scene ?? (viewer.sceneFile === null ? ready(scenes) : undefined);
        if (scene !== undefined) await viewer.openScene(scene);
        const {reflections} = link;
        if (reflections !== undefined) await alerts.attempt('open', () => viewer.openReflections(reflections));
        if (link.eye !== undefined && link.target !== undefined) viewer.stage.look(link.eye, link.target);
        this.expose(link.exposure);
        if (link.object !== undefined) this.query.moveTo(new three.Vector3(...link.object));
        if (link.tab !== undefined) this.tabs.open(link.tab);
    }

    private expose(exposure?: number): void {
        const {stage} = this.viewer;
        if (exposure === undefined) stage.exposeItself();
        else stage.exposure = exposure;
        stage.exposed();
    }

    private choose(kind: 'scenes' | 'volumes'): void {
        const id = (kind === 'scenes' ? this.scenes : this.volumes).value;
        const open = async () => {
            this.status.say('Loading…');
            if (kind === 'scenes') await (id === '' ? this.viewer.closeScene() : this.viewer.openScene(id));
            else await (id === '' ? this.viewer.closeVolume() : this.viewer.openVolume(id));
            if (kind === 'scenes') this.expose();
        };
        void alerts.attempt('open', open).finally(() => {
            this.followShown();
            this.status.sayState();
        });
    }

    /** All that names what is shown: both choices, the status line, the address. */
    private followShown(): void {
        this.selectShown();
        this.status.follow();
        this.keepLink();
    }

    private selectShown(): void {
        choose(this.scenes, this.viewer.sceneFile);
        choose(this.volumes, this.viewer.volume?.file ?? null);
    }

    private whatIsShown(): string {
        const {volume, sceneFile} = this.viewer;
        const words = [sceneFile === null ? '' : nameOf(sceneFile),
                       volume === null ? '' : `${nameOf(volume.file)}: ${counted(volume.probes.probeCount, 'probe')}`];
        return words.filter(word => word !== '').join(' · ') || 'Nothing is open.';
    }

    private showEmpty(sceneCount: number, volumeCount: number): void {
        this.next.hidden = sceneCount === 0 || volumeCount > 0;
        this.empty.hidden = sceneCount > 0 || volumeCount > 0;
        this.empty.replaceChildren(
            element('h2', {}, 'No scene or volume yet'),
            element('p', {}, 'Upload a scene (a binary glTF file, .glb) and bake it in the tab Bakes, or upload ' +
                    'a baked volume (.probes). Files can be dropped here, too.'),
            this.uploadButton());
    }

    private uploadButton(): HTMLElement {
        const input = element('input', {
            type: 'file', accept: '.glb,.probes,.json,.hdr,.exr,.ktx2', multiple: true, class: 'hidden',
            'aria-label': 'Upload files', tabindex: -1,
            change: () => void this.upload([...input.files!]).finally(() => { input.value = ''; }),
        });
        return element('span', {}, button('Upload…', () => input.click()), input);
    }

    private async upload(files: File[]): Promise<void> {
        const kinds: Record<string, Kind> = {glb: 'scenes', probes: 'volumes', json: 'groups', hdr: 'skies', exr: 'skies',
                                             ktx2: 'reflections'};
        alerts.succeed('upload');
        for (const file of files) {
            const dot = file.name.lastIndexOf('.');
            const kind = kinds[file.name.slice(dot + 1).toLowerCase()];
            try {
                if (kind === undefined) throw new Error('is not a .glb, .probes, .json, .hdr, .exr or .ktx2 file');
                this.status.say(`Uploading ${file.name}…`);
                const stored = (await this.api.upload(kind, file, file.name.slice(0, dot))).file;
                if (kind === 'scenes') await this.viewer.openScene(stored.id).then(() => this.expose());
                if (kind === 'volumes') await this.viewer.openVolume(stored.id);
                if (kind === 'reflections') await this.viewer.openReflections(stored.id);
                if (kind === 'groups') await this.groups.open(stored.id);
            } catch (error) {
                alerts.report('upload', error instanceof Unreachable ? error : `${file.name}: ${messageOf(error)}`);
            }
        }
        await alerts.attempt('list', () => this.list());
        this.keepLink();
        this.status.sayState();
    }

    private acceptDrops(view: HTMLElement): void {
        view.addEventListener('dragover', event => event.preventDefault());
        view.addEventListener('drop', event => {
            event.preventDefault();
            void this.upload([...event.dataTransfer!.files]);
        });
    }

    private linkNow(): string {
        const {viewer} = this;
        return toLink({
            volume: viewer.volume?.file.id,
            scene: viewer.sceneFile?.id,
            reflections: viewer.reflectionFile?.id,
            tab: this.tabs.current,
            eye: viewer.stage.camera.position.toArray(),
            target: viewer.stage.controls.target.toArray(),
            object: viewer.volume === null ? undefined : this.query.position,
            exposure: Number(viewer.stage.exposure.toPrecision(4)),
            hidden: [...viewer.hidden],
            color: viewer.color === 'light' ? '' : viewer.color,
            weights: viewer.changedWeights,
        });
    }

    private keepLink(): void {
        if (this.isLoaded) history.replaceState(null, '', this.linkNow());
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

const nameOf = (file: StoredFile) => titleOf({name: file.names.join(', '), id: file.id});

function fill(choice: HTMLSelectElement, title: string, files: StoredFile[]): void {
    choice.replaceChildren(element('option', {value: ''}, title), ...files.map(option));
}

function option(file: StoredFile): HTMLOptionElement {
    return element('option', {value: file.id}, nameOf(file) + (file.state === 'ready' ? '' : ' (damaged)'));
}

/** What is shown may be newer than the list. */
function choose(choice: HTMLSelectElement, file: StoredFile | null): void {
    if (file !== null && ![...choice.options].some(({value}) => value === file.id)) choice.append(option(file));
    choice.value = file?.id ?? '';
}

try {
    const page = new Page();
    Object.assign(window, {tetralight: page});  // for the console, tests and benchmarks
    void page.load();
} catch (error) {
    byId('status').textContent = 'The viewer cannot start.';
    alerts.show(`The viewer needs WebGL 2: ${messageOf(error)}`);
}
