// SPDX-License-Identifier: Apache-2.0
// Chooses two lights of the scene and how they are compared.
import type {Bake, StoredFile} from '../page/api';
import {button, element, labelled, select} from '../page/dom';
import type {Viewer} from '../view/viewer';
import {isOwnSide, kOwnSides, volumeBefore, volumeTitle} from './compare_sides';
import type {CompareMode, Comparison} from './comparison';
import type {Unit} from './difference_pass';

const kModes: [CompareMode, string][] = [['wipe', 'Wipe'], ['difference', 'Difference'], ['off', 'Off']];
const kRanges: Record<Unit, number[]> = {stops: [0.5, 1, 2, 4, 8], percent: [5, 20, 50, 100, 400]};
const kUsualRange: Record<Unit, number> = {stops: 2, percent: 50};

/** Two sides that are often compared; without `sides`, `why` says what is missing. */
interface Choice {
    title: string;
    sides: {left: string; right: string} | null;
    why?: string;
}

export class ComparePanel {
    readonly element: HTMLElement;
    private volumes: StoredFile[] = [];
    private bakes: Bake[] = [];
    private readonly choices = element('div', {class: 'choices', role: 'group', 'aria-label': 'Compare'});
    private readonly reasons = element('p', {class: 'hint'});
    private readonly missing = element('p', {class: 'hint'});
    private readonly controls = element('div');
    private readonly sides = (['left', 'right'] as const).map(side => select(
        [], '', key => void this.comparison.set({[side]: key, mode: this.shownMode})));
    private readonly says = [element('small'), element('small')];
    private readonly modes: HTMLInputElement[];
    private readonly difference = element('div');
    private readonly facts = element('p', {class: 'facts', role: 'status'});
    private readonly unit = select([['stops', 'Stops'], ['percent', 'Percent of the left']], 'stops', unit => void this.comparison.set(
        {unit: unit as Unit, range: kUsualRange[unit as Unit]}));
    private readonly range = select([], '', range => void this.comparison.set({range: Number(range)}));
    private wasOpened = false;

    /** `more`: what else the tab holds. */
    constructor(private readonly viewer: Viewer, private readonly comparison: Comparison, more: HTMLElement) {
        this.modes = kModes.map(([mode]) => element('input', {
            type: 'radio', name: 'compare-mode', value: mode, change: () => void comparison.set({mode})}));
        const modes = element('fieldset', {class: 'modes'}, element('legend', {}, 'Show'), ...kModes.map(
            ([, title], i) => element('label', {class: 'check'}, this.modes[i], title)));
        const rows = (['Left', 'Right'] as const).map((title, i) => {
            const row = labelled(title, this.sides[i]);
            this.says[i].id = `compare-says-${title.toLowerCase()}`;
            this.sides[i].setAttribute('aria-describedby', this.says[i].id);
            row.classList.add('wide');
            row.append(this.says[i]);
            return row;
        });
        this.difference.append(labelled('Difference in', this.unit), labelled('Color range', this.range), this.facts,
                               element('p', {class: 'hint'}, 'Of luminance, before tone mapping. What is more than 10 stops ' +
                                       'below middle grey counts as black.'));
        this.controls.append(this.choices, this.reasons, ...rows, element('div', {class: 'buttons'}, button('Swap sides', () => this.swap())),
                             modes, this.difference,
                             element('p', {class: 'hint'}, 'Both sides have the same exposure. Probes, cells and lightmaps are hidden meanwhile.'));
        this.element = element('section', {'aria-label': 'Compare'}, this.missing, this.controls, more);
        viewer.onChange(() => this.show());
        comparison.onChange(() => this.show());
        this.show();
    }

    setVolumes(volumes: StoredFile[]): void {
        this.volumes = volumes.filter(({state}) => state === 'ready');
        this.show();
    }

    /** The tab is open: the first time, the usual comparison is shown. */
    async open(): Promise<void> {
        const {volume, api} = this.viewer;
        if (volume !== null && !this.wasOpened && !this.comparison.isOn) void this.comparison.set({mode: 'wipe'});
        this.wasOpened = true;
        const [volumes, {bakes}] = await Promise.all([api.list('volumes'), api.get<{bakes: Bake[]}>('/v1/bakes')]);
        this.bakes = bakes;
        this.setVolumes(volumes);
    }

    private get shownMode(): CompareMode {
        const {mode} = this.comparison.state;
        return mode === 'off' ? 'wipe' : mode;
    }

    private swap(): void {
        const {left, right} = this.comparison.state;
        void this.comparison.set({left: right, right: left});
    }

    private usualChoices(open: StoredFile): Choice[] {
        const {data} = this.viewer.volume!.probes;
        const before = volumeBefore(open, this.bakes, this.volumes);
        const other = this.volumes.find(({id}) => id !== open.id);
        return [
            {title: 'Without and with probes', sides: {left: 'ambient', right: 'open'}},
            {title: 'Before and after the bake', sides: before && {left: before.id, right: 'open'},
             why: 'There is no earlier volume of this name: bake again under the same name to compare.'},
            {title: 'Walls ignored and honored', sides: data.visibilityBlocks.length > 0 ? {left: 'plain', right: 'open'} : null,
             why: 'The volume knows no walls: it was made without a scene, or nothing blocks its edges.'},
            {title: 'Two volumes', sides: other ? {left: other.id, right: 'open'} : null,
             why: 'This is the only stored volume.'},
        ];
    }

    private show(): void {
        const {volume} = this.viewer;
        this.missing.textContent = volume === null ? 'Open a volume to compare its light with another.' : '';
        this.missing.hidden = volume !== null;
        this.controls.hidden = volume === null;
        if (volume === null) return;
        const {state} = this.comparison;
        this.showChoices(this.usualChoices(volume.file));
        this.sides.forEach((choice, i) => this.showSide(choice, i));
        for (const input of this.modes) input.checked = input.value === state.mode;
        this.difference.hidden = state.mode !== 'difference';
        this.showDifference();
    }

    private showChoices(choices: readonly Choice[]): void {
        const {state} = this.comparison;
        this.reasons.textContent = choices.filter(({sides}) => sides === null).map(({why}) => why).join(' ');
        this.reasons.hidden = this.reasons.textContent === '';
        const chosen = state.mode === 'off' ? -1 : choices.findIndex(({sides}) => sides?.left === state.left && sides.right === state.right);
        const buttons = choices.map(({title, sides}, i) => {
            return button(title, () => this.choose(i), {disabled: sides === null, 'aria-pressed': String(i === chosen)});
        });
        if (isSame(this.choices, buttons)) return;
        const focused = [...this.choices.children].indexOf(document.activeElement!);
        this.choices.replaceChildren(...buttons);
        buttons[focused]?.focus();
    }

    /** What the choice means now: its button may be older. */
    private choose(i: number): void {
        const {sides} = this.usualChoices(this.viewer.volume!.file)[i];
        if (sides !== null) void this.comparison.set({...sides, mode: this.shownMode});
    }

    private showSide(choice: HTMLSelectElement, i: number): void {
        const {state} = this.comparison;
        const key = i === 0 ? state.left : state.right;
        const open = this.viewer.volume!.file;
        const own = Object.entries(kOwnSides).map(([value, {title}]) => element('option', {value}, title));
        const files = this.volumes.map(file => element('option', {value: file.id}, volumeTitle(file, open, this.bakes)));
        if (!isOwnSide(key) && !this.volumes.some(({id}) => id === key)) {
            files.push(element('option', {value: key}, this.comparison.titleOf(key)));
        }
        const options = [element('optgroup', {label: 'This volume'}, ...own),
                         element('optgroup', {label: 'Stored volumes'}, ...files)];
        if (!isSame(choice, options)) choice.replaceChildren(...options);
        choice.value = key;
        this.says[i].textContent = isOwnSide(key) ? kOwnSides[key].says : 'Light of that volume as it is stored, with its own lights and sky.';
    }

    private showDifference(): void {
        const {comparison: {state: {unit, range}, facts}} = this;
        const sign = unit === 'stops' ? ' stops' : ' %';
        this.unit.value = unit;
        const ranges = [...new Set([...kRanges[unit], range])].sort((a, b) => a - b);
        const options = ranges.map(value => element('option', {value}, `± ${value}${sign}`));
        if (!isSame(this.range, options)) this.range.replaceChildren(...options);
        this.range.value = String(range);
        this.facts.textContent = facts === null ? 'Measuring…' :
            `Mean difference ${facts.mean.toFixed(2)}${sign}; 95 % of the picture at most ${facts.p95.toFixed(2)}${sign}.`;
    }
}

/** Elements that are the same stay, so that they keep the focus. */
const isSame = (shown: HTMLElement, made: readonly HTMLElement[]) =>
    shown.innerHTML === made.map(({outerHTML}) => outerHTML).join('');
