// SPDX-License-Identifier: Apache-2.0
// Measures where light comes through walls, and shows it in the scene and as a table.
import * as three from 'three';

import {colorBar} from '../page/color_bar';
import {kHeatMap} from '../page/color_maps';
import {counted} from '../page/colors';
import {button, checkbox, element, labelled, select} from '../page/dom';
import type {Viewer} from '../view/viewer';
import {checkLeaks, kLeakKinds, LeakKind, LeakPlace, leakShares, worstPlaces} from './leak_check';
import {LeakMap} from './leak_map';
import {meanAndP95} from './mean_p95';

const kRows = 20;
const kPlaces = ['250', '500', '1000', '2000', '4000'];

export class LeakPanel {
    readonly element: HTMLElement;
    private readonly map = new LeakMap();
    private places: LeakPlace[] = [];
    /** Of the report of the bake, which looked for places that see no probe. */
    private isOfBake = false;
    private kind: LeakKind = 'through_walls';
    private count = 500;
    private stop: AbortController | null = null;
    private isMapWanted = true;
    private isActiveNow = true;
    private readonly check = button('Check for leaks', () => void this.run(), {class: 'main'});
    private readonly cancel = button('Cancel the check', () => this.stop?.abort());
    private readonly progress = element('progress', {max: 1, value: 0, 'aria-label': 'Places that are checked'});
    private readonly facts = element('p', {class: 'facts', role: 'status'});
    private readonly body = element('tbody');
    private readonly result = element('div');
    private readonly kinds = select(Object.entries(kLeakKinds), this.kind, kind => {
        this.kind = kind as LeakKind;
        this.show();
    });

    /** `stopComparing`: a comparison hides the places. */
    constructor(private readonly viewer: Viewer, private readonly stopComparing: () => void) {
        viewer.marks.others.add(this.map.group);
        const head = ['Place', 'Share', 'Volume', 'Traced'].map(name => element('th', {scope: 'col'}, name));
        this.result.append(
            labelled('Map', this.kinds),
            checkbox('Show the places in the scene', true, isOn => {
                this.isMapWanted = isOn;
                this.showMap();
            }),
            colorBar(kHeatMap, 'Share of the mean light (grey: less than 0.1 %)', ['0.1 %', '1 %', '10 %', '100 %']),
            this.facts,
            element('div', {class: 'scroll', tabindex: 0, role: 'region', 'aria-label': 'Worst places'},
                    element('table', {}, element('caption', {}, 'Worst places: a click moves the camera there'),
                            element('thead', {}, element('tr', {}, ...head)), this.body)));
        this.element = element(
            'section', {'aria-label': 'Leaks'}, element('h2', {}, 'Light through walls and coverage'),
            element('p', {class: 'hint'}, 'The server traces the light at random places of free space and compares it with ' +
                    'the light of the volume.'),
            labelled('Places', select(kPlaces.map(count => [count, count]), String(this.count),
                                      count => { this.count = Number(count); })),
            element('div', {class: 'buttons'}, this.check, this.cancel), this.progress, this.result);
        viewer.onChange(() => this.forget());
        this.forget();
    }

    /** Places are shown while the tab is open. */
    set isActive(isActive: boolean) {
        this.isActiveNow = isActive;
        this.applyMap();
    }

    private showMap(): void {
        if (this.isMapWanted) this.stopComparing();
        this.applyMap();
    }

    private applyMap(): void {
        this.map.group.visible = this.isActiveNow && this.isMapWanted;
        this.viewer.stage.draw();
    }

    /** Another volume or scene. */
    private forget(): void {
        this.stop?.abort();
        this.places = [];
        const unseen = this.viewer.volume?.file.facts?.unseen as {positions?: number[][]} | null | undefined;
        this.isOfBake = (unseen?.positions?.length ?? 0) > 0;
        if (this.isOfBake) {
            this.kind = 'unseen';
            this.places = unseen!.positions!.map(position => (
                {position, is_unseen: true, through_walls: 0, missing: 0, answer: NaN, traced: NaN}));
        }
        this.show();
    }

    private async run(): Promise<void> {
        const {viewer} = this;
        const {volume, sceneFile, bake} = viewer;
        if (volume === null || sceneFile === null) return;
        const stop = new AbortController();
        this.stop = stop;
        this.places = [];
        if (this.isOfBake) this.kind = 'through_walls';
        this.isOfBake = false;
        this.show();
        this.showMap();
        await viewer.alerts.attempt('leaks', async () => {
            try {
                const order = {scene: sceneFile.id, volume: volume.file.id, bake, places: this.count};
                const warnings = await checkLeaks(viewer.api, order, stop.signal, places => {
                    if (stop.signal.aborted) return;
                    this.places = places;
                    this.show();
                });
                if (warnings.length > 0) viewer.say(warnings.join(' '));
            } catch (error) {
                if (!stop.signal.aborted) throw error;
            }
        });
        if (this.stop === stop) this.stop = null;
        this.show();
    }

    private show(): void {
        const {viewer, places, kind} = this;
        const isRunning = this.stop !== null && !this.stop.signal.aborted;
        const isReady = (viewer.volume?.file.id ?? '') !== '' && viewer.sceneFile !== null;  // previews are not stored
        this.check.disabled = isRunning || !isReady;
        this.check.title = isReady ? '' : 'Open a volume and its scene.';
        this.cancel.hidden = this.progress.hidden = !isRunning;
        this.progress.value = places.length / this.count;
        this.result.hidden = places.length === 0;
        this.kinds.value = kind;
        const shares = leakShares(places, kind);
        this.facts.textContent = this.isOfBake ? `The bake found ${counted(places.length, 'place')} that see no probe of their cell. ` +
            'Check for leaks to measure their light.' : places.length > 0 ? this.words(shares) : '';
        this.body.replaceChildren(...worstPlaces(shares, kRows).map(place => this.row(place, shares[place])));
        const size = viewer.box.getSize(new three.Vector3()).length();
        this.map.show(places.map(({position}) => position), shares, Math.min(0.12, size / 200));
        viewer.stage.draw();
    }

    private words(shares: readonly number[]): string {
        const checked = `${counted(shares.length, 'place')} checked`;
        const unseen = this.places.filter(({is_unseen}) => is_unseen).length;
        const covered = unseen === 0 ? 'All of them see a probe of their cell.' :
            `${unseen === 1 ? 'One of them sees' : `${unseen} of them see`} no probe of their cell.`;
        if (this.kind === 'unseen') return `${checked}. ${covered}`;
        const [mean, p95] = meanAndP95(shares);
        return `${checked}. ${kLeakKinds[this.kind]}: mean ${percent(mean)}, 95 % of the places at most ${percent(p95)} ` +
            `of the mean light. ${covered}`;
    }

    private row(place: number, share: number): HTMLElement {
        const {position, answer, traced} = this.places[place];
        const words = position.map(x => x.toFixed(2)).join(', ');
        const number = (text: string) => element('td', {class: 'number'}, text);
        const made: HTMLElement = element('tr', {}, element('td', {}, button(words, () => {
            for (const other of this.body.rows) other.removeAttribute('aria-current');
            made.setAttribute('aria-current', 'true');
            this.look(place);
        }, {class: 'link', 'aria-label': `Show the place ${words}`})),
            number(this.kind === 'unseen' ? 'unseen' : percent(share)), number(light(answer)), number(light(traced)));
        return made;
    }

    private look(place: number): void {
        const {stage} = this.viewer;
        const at = new three.Vector3().fromArray(this.places[place].position);
        const away = stage.camera.position.clone().sub(stage.controls.target);
        away.setLength(Math.min(away.length(), 4));
        this.map.select(place);
        stage.look(at.clone().add(away).toArray(), at.toArray());
        stage.endMove();
    }
}

/** Two digits: shares are often tiny. */
const percent = (share: number) => `${Number((100 * share).toPrecision(2))} %`;
const light = (value: number) => Number.isFinite(value) ? String(Number(value.toPrecision(3))) : '–';
