// SPDX-License-Identifier: Apache-2.0
// Elements without a framework.

type Child = Node | string;
type Attributes = Record<string, string | number | boolean | ((event: never) => void)>;

/** An element; functions are listeners, `true` is an attribute without a value, `false` none. */
export function element<K extends keyof HTMLElementTagNameMap>(
    tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) {
        if (typeof value === 'function') {
            made.addEventListener(name, value as unknown as EventListener);
        } else if (value !== false) {
            made.setAttribute(name, value === true ? '' : String(value));
        }
    }
    made.append(...children);
    return made;
}

let idCount = 0;

/** A control with its label, and what it means as a hint that screen readers read too. */
export function labelled<T extends HTMLElement>(text: string, control: T, hint = ''): HTMLElement {
    control.id ||= `control-${++idCount}`;
    const label = element('label', {for: control.id}, text);
    const row = element('div', {class: 'row'}, label, control);
    if (hint !== '') {
        const note = element('small', {id: control.id + '-hint'}, hint);
        control.setAttribute('aria-describedby', note.id);
        row.append(note);
    }
    return row;
}

export function button(text: string, act: () => void, attributes: Attributes = {}): HTMLButtonElement {
    return element('button', {type: 'button', click: act, ...attributes}, text);
}

export function checkbox(text: string, isOn: boolean, change: (isOn: boolean) => void): HTMLElement {
    const input = element('input', {type: 'checkbox', change: () => change(input.checked)});
    input.checked = isOn;
    return element('label', {class: 'check'}, input, text);
}

/** Buttons of which one is chosen; `value` shows another. */
export function radios<T extends string>(legend: string, options: [value: T, text: string, key?: string][],
                                         change: (value: T) => void, layout = ''): {element: HTMLElement; value: T} {
    const name = `control-${++idCount}`;
    const inputs = options.map(([value]) => element('input', {type: 'radio', name, value, change: () => change(value)}));
    const made = element('fieldset', {class: `radios ${layout}`}, element('legend', {}, legend), ...options.map(
        ([, text, key], i) => element('label', key === undefined ? {} : {title: `Key: ${key}`}, inputs[i], text)));
    return {
        element: made,
        get value() { return inputs.find(input => input.checked)!.value as T; },
        set value(value: T) { for (const input of inputs) input.checked = input.value === value; },
    };
}

/** A number of a range; others change nothing. */
export function numberInput(text: string, range: Attributes, change: (value: number) => void): HTMLElement {
    const input = element('input', {type: 'number', ...range, change: () => {
        if (faultOf(input) === '') input.dataset.held = input.value;
        else input.value = input.dataset.held!;
        change(Number(input.dataset.held));
    }});
    input.dataset.held = input.value;
    return labelled(text, input);
}

/** A slider that says its number. */
export function slider(text: string, range: {min: number; max: number; step: number; value: number},
                       change: (value: number) => void): HTMLElement {
    const {min, max, step, value} = range;
    const output = element('output', {}, String(value));
    const input = element('input', {
        type: 'range', min, max, step,
        input: () => {
            output.textContent = input.value;
            change(Number(input.value));
        },
    });
    input.value = String(value);
    const row = labelled(text, input);
    output.setAttribute('for', input.id);
    row.append(output);
    return row;
}

export function select(options: [value: string, text: string][], value: string,
                       change: (value: string) => void): HTMLSelectElement {
    const made = element('select', {change: () => change(made.value)});
    for (const [key, text] of options) made.append(element('option', {value: key}, text));
    made.value = value;
    return made;
}

/** Why a number field cannot be taken; nothing where it can. */
function faultOf(input: HTMLInputElement): string {
    const {badInput, rangeUnderflow, rangeOverflow} = input.validity;
    if (badInput) return 'this is not a number';
    if (input.value === '') return 'the field is empty';
    if (rangeUnderflow) return `${input.value} is less than ${input.min}`;
    return rangeOverflow ? `${input.value} is more than ${input.max}` : '';
}

/** The number of a field that is sent with a button; the error where there is none names the field. */
export function numberToSend(input: HTMLInputElement): number {
    const fault = faultOf(input);
    input.setAttribute('aria-invalid', String(fault !== ''));
    if (fault === '') return input.valueAsNumber;
    input.focus();
    throw new Error(`${input.labels![0].textContent}: ${fault}`);
}

function showHeld(input: HTMLInputElement): void {
    input.value = String(Number(Number(input.dataset.held).toFixed(3)));
}

/** Beyond it from the origin, floats are too coarse for the light of a room. */
export const kMostMeters = 1e6;

/** Three numbers side by side. What is no number of their range changes nothing: the one that holds returns. */
export function vectorInput(text: string, values: readonly number[], range: Attributes,
                            change: (values: number[]) => void): HTMLElement {
    const inputs = values.map((_, axis) => {
        const input = element('input', {
            type: 'number', min: -kMostMeters, max: kMostMeters, ...range, 'aria-label': `${text} ${'xyz'[axis]}`,
            change: () => {
                if (faultOf(input) === '') {
                    input.dataset.held = input.value;
                    change(inputs.map(other => Number(other.dataset.held)));
                }
                showHeld(input);
            },
            blur: () => showHeld(input),
        });
        return input;
    });
    const made = element('fieldset', {class: 'vector'}, element('legend', {}, text), ...inputs);
    setVector(made, values);
    return made;
}

/** Sets the numbers of a `vectorInput`, but shows none where someone types. */
export function setVector(fieldset: HTMLElement, values: readonly number[]): void {
    fieldset.querySelectorAll('input').forEach((input, axis) => {
        input.dataset.held = String(values[axis]);
        if (document.activeElement !== input) showHeld(input);
    });
}
