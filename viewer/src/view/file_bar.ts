// SPDX-License-Identifier: Apache-2.0
// The bar that chooses scene and volume; uploads, and files that are dropped on the view.
import {ApiError, Kind, messageOf, namesOf, StoredFile, Unreachable} from '../page/api';
import {button, element} from '../page/dom';
import type {StatusLine} from '../page/status_line';
import type {Viewer} from './viewer';

export interface StoredFiles {
    scenes: StoredFile[];
    volumes: StoredFile[];
    reflections: StoredFile[];
}

export interface FileActions {
    listed(files: StoredFiles): void;
    /** Called after something was chosen or uploaded. */
    opened(): void;
    openGroups(id: string): Promise<void>;
    openBakeTab(): void;
}

const kUploads: Record<string, Kind> = {
    glb: 'scenes', probes: 'volumes', json: 'groups', hdr: 'skies', exr: 'skies', ktx2: 'reflections'};

export class FileBar {
    readonly elements: HTMLElement[];
    private readonly scenes = element('select', {'aria-label': 'Scene', change: () => this.choose('scenes')});
    private readonly volumes = element('select', {'aria-label': 'Probe volume', change: () => this.choose('volumes')});
    /** In the view: what to do first. */
    private readonly noVolume: HTMLElement;
    private readonly nothing = element('div', {class: 'empty', hidden: true});

    constructor(private readonly viewer: Viewer, private readonly status: StatusLine, private readonly actions: FileActions) {
        const {parent} = viewer.stage;
        this.elements = [this.scenes, this.volumes, this.uploadButton()];
        this.noVolume = element('p', {class: 'next', hidden: true}, 'No volume yet: ',
                                button('bake one', () => actions.openBakeTab(), {class: 'link'}));
        parent.append(this.nothing, this.noVolume);
        this.acceptDrops(parent);
    }

    /** Reads what the service stores. */
    async list(): Promise<StoredFiles> {
        const {api} = this.viewer;
        const [scenes, volumes, reflections] = await Promise.all(
            [api.list('scenes'), api.list('volumes'), api.list('reflections')]);
        fill(this.scenes, 'Scene…', scenes);
        fill(this.volumes, 'Volume…', volumes);
        this.follow();
        const files = {scenes, volumes, reflections};
        this.actions.listed(files);
        this.sayWhatToDo(files);
        return files;
    }

    /** Selects what is shown. */
    follow(): void {
        const {sceneFile, volume} = this.viewer;
        if (volume !== null) this.noVolume.hidden = true;
        select(this.scenes, sceneFile);
        select(this.volumes, volume?.file ?? null);
    }

    private choose(kind: 'scenes' | 'volumes'): void {
        const {viewer, viewer: {stage, alerts}} = this;
        const id = this[kind].value;
        const open = async () => {
            this.status.say('Loading…');
            if (kind === 'scenes') await (id === '' ? viewer.closeScene() : viewer.open.sceneInItsLight(id));
            else await (id === '' ? viewer.closeVolume() : viewer.open.volume(id));
            if (kind === 'scenes') await stage.exposeItself();
        };
        const openOrList = () => open().catch(async error => {
            if (error instanceof ApiError && error.status === 404) await this.list();  // it was deleted meanwhile
            throw error;
        });
        void stage.whileLoading(() => alerts.attempt('open', openOrList)).finally(() => {
            this.actions.opened();
            this.status.follow();
        });
    }

    private sayWhatToDo({scenes, volumes}: StoredFiles): void {
        this.noVolume.hidden = scenes.length === 0 || volumes.length > 0 || this.viewer.volume !== null;
        this.nothing.hidden = scenes.length > 0 || volumes.length > 0;
        this.nothing.replaceChildren(
            element('h2', {}, 'No scene or volume yet'),
            element('p', {}, 'Upload a scene (a binary glTF file, .glb) and bake it in the tab Bake, or upload ' +
                    'a baked volume (.probes). Files can be dropped here, too.'),
            this.uploadButton());
    }

    private uploadButton(): HTMLElement {
        const input = element('input', {
            type: 'file', accept: Object.keys(kUploads).map(ending => `.${ending}`).join(), multiple: true, class: 'hidden',
            'aria-label': 'Upload files', tabindex: -1,
            change: () => void this.upload([...input.files!]).finally(() => { input.value = ''; }),
        });
        return element('span', {}, button('Upload…', () => input.click()), input);
    }

    private acceptDrops(view: HTMLElement): void {
        view.addEventListener('dragover', event => event.preventDefault());
        view.addEventListener('drop', event => {
            event.preventDefault();
            void this.upload([...event.dataTransfer!.files]);
        });
    }

    private async upload(files: File[]): Promise<void> {
        const {alerts} = this.viewer;
        alerts.succeed('upload');
        for (const file of files) {
            try {
                await this.uploadOne(file);
            } catch (error) {
                alerts.report('upload', error instanceof Unreachable ? error : `${file.name}: ${messageOf(error)}`);
            }
        }
        await alerts.attempt('list', () => this.list());
        this.actions.opened();
        this.status.follow();
    }

    /** Stores a file, and opens it. */
    private async uploadOne(file: File): Promise<void> {
        const {api, open, stage} = this.viewer;
        const dot = file.name.lastIndexOf('.');
        const kind = kUploads[file.name.slice(dot + 1).toLowerCase()];
        if (kind === undefined) throw new Error('is not a .glb, .probes, .json, .hdr, .exr or .ktx2 file');
        this.status.say(`Uploading ${file.name}…`);
        const {id} = (await api.upload(kind, file, file.name.slice(0, dot))).file;
        if (kind === 'scenes') await open.sceneInItsLight(id).then(() => stage.exposeItself());
        if (kind === 'volumes') await open.volume(id);
        if (kind === 'reflections') await open.reflections(id);
        if (kind === 'groups') await this.actions.openGroups(id);
    }
}

function fill(choice: HTMLSelectElement, title: string, files: StoredFile[]): void {
    choice.replaceChildren(element('option', {value: ''}, title), ...files.map(option));
}

function option(file: StoredFile): HTMLOptionElement {
    return element('option', {value: file.id}, namesOf(file) + (file.state === 'ready' ? '' : ' (damaged)'));
}

/** What is shown may be newer than the list. */
function select(choice: HTMLSelectElement, file: StoredFile | null): void {
    if (file !== null && ![...choice.options].some(({value}) => value === file.id)) choice.append(option(file));
    choice.value = file?.id ?? '';
}
