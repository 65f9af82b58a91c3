// SPDX-License-Identifier: Apache-2.0
// A field for each setting of a bake, in sections.
import {element, labelled} from '../page/dom';
import {BakeField, BakeSection, valueOf} from './bake_fields';

type Control = HTMLInputElement | HTMLSelectElement;

export class SettingFields {
    readonly element = element('div');
    private readonly controls = new Map<BakeField, Control>();

    /** `changed` is called with the key of a setting that someone has changed. */
    constructor(private readonly changed: (key: string) => void) {}

    get fields(): BakeField[] {
        return [...this.controls.keys()];
    }

    clear(): void {
        this.controls.clear();
        this.element.replaceChildren();
    }

    make(sections: readonly BakeSection[]): void {
        this.clear();
        this.element.append(...sections.map(({title, isFirst, fields}) => element(
            'details', isFirst ? {'data-first': true} : {}, element('summary', {}, title),
            ...fields.map(field => labelled(field.label, this.control(field), `${field.hint} Default: ${field.default}.`)))));
    }

    openFirstSections(): void {
        for (const details of this.element.querySelectorAll('details')) details.open ||= 'first' in details.dataset;
    }

    /** Sets the texts of fields by the keys of their settings; undefined leaves one as it is. */
    fill(textOf: (key: string) => string | undefined): void {
        for (const [{key}, control] of this.controls) control.value = textOf(key) ?? control.value;
    }

    /** Adds all settings that are not empty to an order. */
    addTo(order: Record<string, unknown>): void {
        for (const [field, control] of this.controls) {
            control.removeAttribute('aria-invalid');
            try {
                const value = valueOf(field, control.value);
                if (value !== undefined) order[field.key] = value;
            } catch (error) {
                this.mark(field.key);
                throw error;
            }
        }
    }

    /** Shows that a setting is wrong, if it has a field; the result is the field's label. */
    mark(wrong: string): string | undefined {
        const [field, control] = [...this.controls].find(([{key}]) => key === wrong) ?? [];
        if (control === undefined) return undefined;
        control.setAttribute('aria-invalid', 'true');
        control.closest('details')!.open = true;
        control.focus();
        return field!.label;
    }

    private control(field: BakeField): Control {
        const change = () => this.changed(field.key);
        let made: Control;
        if (field.kind === 'choice' || field.kind === 'flag') {
            const options = field.kind === 'flag' ? ['true'] : field.options!;
            made = element('select', {change}, element('option', {value: ''}, `default (${field.default})`),
                           ...options.map(option => element('option', {value: option}, option === 'true' ? 'yes' : option)));
        } else {
            made = element('input', {type: 'text', placeholder: field.default, autocomplete: 'off', change,
                                     inputmode: field.kind === 'number' || field.kind === 'integer' ? 'decimal' : 'text'});
        }
        made.name = field.key;
        this.controls.set(field, made);
        return made;
    }
}
