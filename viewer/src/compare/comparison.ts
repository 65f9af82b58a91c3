// SPDX-License-Identifier: Apache-2.0
// Two lights of the same scene in one picture: side by side at a divider, or their difference.
import {ambientOf, constantAnswers, kNoLight, plainAnswers} from '../light/answers';
import {OtherLight} from '../light/other_light';
import {isBaked, openVolume, OpenVolume} from '../light/volume';
import type {Bake, StoredFile} from '../page/api';
import {colorBar} from '../page/color_bar';
import {kDifferenceMap} from '../page/color_maps';
import {drawStrip} from '../view/canvas_target';
import {hideMarks} from '../view/meter';
import type {Viewer} from '../view/viewer';
import {isOwnSide, kOwnSides, OwnSide, volumeTitle} from './compare_sides';
import {DifferenceFacts, DifferencePass, Unit} from './difference_pass';
import {Wipe} from './wipe';

export type CompareMode = 'off' | 'wipe' | 'difference';

export interface CompareState {
    mode: CompareMode;
    /** Keys of `kOwnSides` or ids of volumes. */
    left: string;
    right: string;
    /** Of the divider, from 0 = left to 1 = right. */
    split: number;
    unit: Unit;
    /** The difference at the ends of the color map. */
    range: number;
}

export const kUsualComparison: CompareState = {
    mode: 'off', left: 'ambient', right: 'open', split: 0.5, unit: 'stops', range: 2,
};

/** What is this much darker than middle grey counts as black in differences. */
const kDarkStops = 10;
const kStillMilliseconds = 200;

interface Side {
    title: string;
    light: OtherLight | null;  // null: the light of the open volume
}

export class Comparison {
    state: CompareState = kUsualComparison;
    /** Of the last difference, when the picture is still. */
    facts: DifferenceFacts | null = null;
    private readonly sides = new Map<string, Side>();
    private readonly wipe: Wipe;
    private pass: DifferencePass | null = null;
    /** Those of the sides. */
    private readonly volumes = new Map<string, OpenVolume>();
    private timer = 0;
    private round = 0;  // of `set`
    private shown = {left: '', right: ''};  // keys of the sides; those of the state may still be fetched
    private isResting = false;
    private opened = '';  // the stored volume that was opened last
    private readonly listeners: (() => void)[] = [];

    constructor(private readonly viewer: Viewer) {
        this.wipe = new Wipe(viewer.stage.parent, split => {
            this.state = {...this.state, split};
            viewer.stage.draw();
            this.tell();
        }, () => void this.set({mode: 'off'}));
        viewer.onChange(() => {
            this.followVolume();
            this.dropSides(() => true);
            void this.set({});
        });
        viewer.onLight(() => {
            this.dropSides(isOwnSide);
            void this.set({});
        });
    }

    /** Called when something else is compared, in another way, or with another result. */
    onChange(listener: () => void): void {
        this.listeners.push(listener);
    }

    get isOn(): boolean {
        return this.state.mode !== 'off' && this.viewer.volume !== null && !this.isResting;
    }

    /** While something else has the view. */
    rest(isResting: boolean): void {
        if (isResting === this.isResting) return;
        this.isResting = isResting;
        void this.set({});
    }

    titleOf(key: string): string {
        return this.sides.get(key)?.title ?? (isOwnSide(key) ? kOwnSides[key].title : key.slice(0, 8));
    }

    /** Fetches what is needed, then shows it. */
    async set(changes: Partial<CompareState>): Promise<void> {
        this.state = {...this.state, ...changes};
        const round = ++this.round;
        if (this.isOn) await this.viewer.alerts.attempt('compare', () => this.load());
        if (round !== this.round) return;
        const isUsed = (key: string) => key === this.state.left || key === this.state.right;
        this.dropSides(key => !isUsed(key));
        for (const id of this.volumes.keys()) if (!isUsed(id)) this.volumes.delete(id);
        this.show();
    }

    /** A side that showed the volume that is opened now shows the one that was open before. */
    private followVolume(): void {
        const open = this.viewer.volume?.file.id ?? '';
        const before = this.opened;
        if (open === '' || open === before) return;
        this.opened = open;
        for (const side of ['left', 'right'] as const) {
            if (this.state[side] === open) this.state = {...this.state, [side]: before || kUsualComparison.left};
        }
    }

    private async load(): Promise<void> {
        for (const side of ['left', 'right'] as const) {
            const key = this.state[side];
            if (this.sides.has(key)) continue;
            try {
                const made = isOwnSide(key) ? this.ownSide(key) : await this.volumeSide(key);
                if (this.sides.has(key)) made.light?.dispose();
                else this.sides.set(key, made);
            } catch (error) {
                this.state = {...this.state, [side]: 'open'};
                this.sides.set('open', this.ownSide('open'));
                throw error;
            }
        }
    }

    private ownSide(key: OwnSide): Side {
        const {probes} = this.viewer.volume!;
        const {title} = kOwnSides[key];
        if (key === 'open' || !isBaked(probes)) return {title, light: null};
        const answers = key === 'plain' ? plainAnswers(probes) : constantAnswers(key === 'none' ? kNoLight : ambientOf(probes));
        const light = OtherLight.ofProbes(answers);
        light.place(this.viewer.probeLight.grid);
        return {title, light};
    }

    private async volumeSide(id: string): Promise<Side> {
        const {api} = this.viewer;
        const file = await api.get<StoredFile>(`/v1/volumes/${encodeURIComponent(id)}`);
        const {bakes} = await api.get<{bakes: Bake[]}>('/v1/bakes');
        const title = volumeTitle(file, this.viewer.volume?.file ?? null, bakes);
        const volume = this.volumes.get(id) ?? openVolume(await api.bytes(`/v1/volumes/${file.id}/file`), file);
        if (!isBaked(volume.probes)) throw new Error(`the volume ${title} is not baked: it has no light to compare`);
        this.volumes.set(id, volume);
        const light = OtherLight.ofVolume(volume, this.viewer.box);
        light.place(this.viewer.probeLight.grid);
        return {title, light};
    }

    private dropSides(which: (key: string) => boolean): void {
        this.viewer.stage.painter = null;  // until all sides are there again
        for (const [key, {light}] of this.sides) {
            if (!which(key)) continue;
            light?.dispose();
            this.sides.delete(key);
        }
    }

    private show(): void {
        const {stage} = this.viewer;
        const {mode, left, right, split} = this.state;
        const isOn = this.isOn && this.sides.has(left) && this.sides.has(right);
        this.shown = {left, right};
        this.viewer.isComparing = isOn;
        this.facts = null;
        stage.painter = !isOn ? null : {
            draw: () => mode === 'wipe' ? this.paintWipe() : this.paintDifference(),
            drawLight: () => this.paintSide('right', stage.renderer.shadowMap.needsUpdate),
        };
        const titles = [this.titleOf(left), this.titleOf(right)] as const;
        if (!isOn) this.wipe.hide();
        else if (mode === 'wipe') this.wipe.show(titles, split);
        else this.wipe.showDifference(titles, this.legend());
        stage.draw();
        this.tell();
    }

    private legend(): HTMLElement {
        const {unit, range} = this.state;
        const ticks = [-1, -0.5, 0, 0.5, 1].map(x => `${x > 0 ? '+' : x < 0 ? '−' : ''}${Math.abs(x) * range}`);
        const caption = `Right is darker (−) or brighter (+), ${unit === 'stops' ? 'stops' : '% of the left'}`;
        return colorBar(kDifferenceMap, caption, ticks);
    }

    private lightOf(side: 'left' | 'right'): OtherLight | null {
        return this.sides.get(this.shown[side])!.light;
    }

    private paintWipe(): void {
        const {stage: {renderer}} = this.viewer;
        const {split} = this.state;
        const areShadowsDue = renderer.shadowMap.needsUpdate;
        drawStrip(renderer, 0, split, () => this.paintSide('left', areShadowsDue));
        drawStrip(renderer, split, 1, () => this.paintSide('right', areShadowsDue));
    }

    private paintDifference(): void {
        const {stage} = this.viewer;
        this.pass ??= new DifferencePass(stage.renderer);
        const showMarks = hideMarks(stage.scene);
        const {unit, range} = this.state;
        const areShadowsDue = stage.renderer.shadowMap.needsUpdate;
        this.pass.draw([() => this.paintSide('left', areShadowsDue), () => this.paintSide('right', areShadowsDue)],
                       {unit, range, floor: 0.18 / stage.exposure * 2 ** -kDarkStops});
        showMarks();
        clearTimeout(this.timer);
        this.timer = window.setTimeout(() => this.measure(), kStillMilliseconds);
    }

    /** Each group of lights has shadow maps of its own, which stay until something that casts shadows moves. */
    private paintSide(side: 'left' | 'right', areShadowsDue: boolean): void {
        const {stage} = this.viewer;
        const light = this.lightOf(side);
        const isNew = light?.hasNoShadows ?? false;
        stage.renderer.shadowMap.needsUpdate = areShadowsDue || isNew;
        this.viewer.drawBy(light, () => stage.render());
        stage.renderer.shadowMap.needsUpdate = false;
    }

    private measure(): void {
        if (!this.isOn || this.state.mode !== 'difference' || this.pass === null) return;
        this.facts = this.pass.measure();
        this.tell();
    }

    private tell(): void {
        for (const listener of this.listeners) listener();
    }
}
