// SPDX-License-Identifier: Apache-2.0
// The selected box in numbers.
import {element, labelled, select, setVector, vectorInput} from '../page/dom';
import type {Snapping} from '../view/snapping';
import type {BoxKind, BoxSetting} from './box_kinds';
import {Box, kLeastSide, resize, SettingValue, withSetting} from './boxes';
import type {Position} from './groups';

type Change = (box: Box) => void;

interface Field {
    element: HTMLElement;
    show(box: Box): void;
}

export class BoxFields {
    readonly element = element('div');
    private box: Box | null = null;
    private key = '';
    private fields: Field[] = [];

    constructor(private readonly kind: BoxKind, private readonly snapping: Snapping, private readonly change: Change) {}

    /** Fields that are there stay, so that who types keeps the focus. */
    show(box: Box): void {
        const {kind, snapping} = this;
        const key = `${box.shape} ${snapping.meters} ${snapping.degrees}`;
        this.box = box;
        if (key !== this.key) {
            this.key = key;
            this.fields = makeFields(box, kind, snapping, () => this.box!, this.change);
            this.element.replaceChildren(...this.fields.map(field => field.element));
        }
        for (const field of this.fields) field.show(box);
    }
}

function makeFields(box: Box, kind: BoxKind, snapping: Snapping, now: () => Box, change: Change): Field[] {
    const vector = (legend: string, key: 'position' | 'rotation' | 'size' | 'offset', range: Record<string, number>): Field => {
        const isFlat = key === 'size' && box.shape === 'rectangle';
        const values = (b: Box) => isFlat ? b.size.slice(0, 2) : b[key];
        const made = vectorInput(legend, values(box), range, to => {
            const value = [...to, 0, 0].slice(0, 3) as unknown as Position;
            change(key === 'size' ? resize(now(), value) : {...now(), [key]: value});
        });
        return {element: made, show: b => setVector(made, values(b))};
    };
    const sizes = box.shape === 'rectangle' ? 'Width and height, metres' : box.shape === 'sphere' ? 'Diameter, metres' : 'Size, metres';
    return [
        nameField(now, change),
        ...kind.id === 'adjustments' ? [shapeField(now, change)] : [],
        vector(kind.id === 'reflections' ? 'Capture, metres' : 'Position, metres', 'position', {step: snapping.meters}),
        ...kind.id === 'reflections' ? [vector('Middle of the box from the capture, metres', 'offset', {step: snapping.meters})] : [],
        vector(sizes, 'size', {min: kLeastSide, step: snapping.meters}),
        vector('Rotation, degrees', 'rotation', {min: -180, max: 180, step: snapping.degrees}),
        ...kind.settings.map(setting => settingField(setting, now, change)),
    ];
}

function nameField(now: () => Box, change: Change): Field {
    const input = element('input', {type: 'text', maxlength: 200, change: () => {
        if (input.value.trim() === '') input.value = now().name;
        else if (input.value !== now().name) change({...now(), name: input.value.trim()});
    }});
    return {element: labelled('Name', input), show: box => { if (document.activeElement !== input) input.value = box.name; }};
}

function shapeField(now: () => Box, change: Change): Field {
    const choice = select([['box', 'box'], ['sphere', 'sphere']], 'box', shape => {
        const box = now();
        const [x] = box.size;
        change({...box, shape: shape as Box['shape'], size: shape === 'sphere' ? [x, x, x] : box.size});
    });
    return {element: labelled('Shape', choice), show: box => { choice.value = box.shape; }};
}

function settingField(setting: BoxSetting, now: () => Box, change: Change): Field {
    const {key, label, hint, type, min, max, step, without, choices} = setting;
    const put = (value: SettingValue | undefined) => change(withSetting(now(), key, value));
    if (type === 'choice') {
        const choice = select([['', without], ...choices!], '', value => put(value === '' ? undefined : value === 'true'));
        return {element: labelled(label, choice, hint), show: box => { choice.value = String(box.settings[key] ?? ''); }};
    }
    const shown = (box: Box) => String(box.settings[key] ?? '');
    const range = Object.fromEntries(Object.entries({min, max, step}).filter(([, limit]) => limit !== undefined)) as Record<string, number>;
    const input = element('input', {type: type === 'layers' ? 'text' : 'number', placeholder: without, ...range, change: () => {
        const value = type === 'layers' ? layersOf(input.value) : numberOf(input, setting);
        input.setAttribute('aria-invalid', String(value === null));
        if (type === 'layers') input.setCustomValidity(value === null ? hint : '');
        if (value === null) return void input.reportValidity();
        put(value);
    }});
    return {
        element: labelled(label, input, hint),
        show: box => {
            if (document.activeElement === input) return;
            input.value = shown(box);
            input.removeAttribute('aria-invalid');
        },
    };
}

/** Undefined: no value; null: not one of its range. */
function numberOf(input: HTMLInputElement, {isInteger}: BoxSetting): number | undefined | null {
    const {badInput, rangeUnderflow, rangeOverflow} = input.validity;
    if (badInput || rangeUnderflow || rangeOverflow) return null;
    if (input.value === '') return undefined;
    return isInteger ? Math.round(input.valueAsNumber) : input.valueAsNumber;
}

/** "0, 3" → [0, 3]. */
export function layersOf(text: string): number[] | undefined | null {
    const words = text.split(',').map(word => word.trim()).filter(word => word !== '');
    if (words.length === 0) return undefined;
    const layers = words.map(Number);
    return layers.every(layer => Number.isInteger(layer) && layer >= 0 && layer < 32) ? layers : null;
}
