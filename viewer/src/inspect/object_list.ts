// SPDX-License-Identifier: Apache-2.0
// The objects of the scene by name: arrow keys go through them, a field finds them.
import {counted} from '../page/colors';
import {element, labelled} from '../page/dom';
import type {SceneObject} from '../scene/scene_objects';

export class ObjectList {
    readonly element: HTMLElement;
    private readonly find = element('input', {type: 'search', placeholder: 'Name', input: () => this.fill()});
    private readonly list = element('select', {size: 7, 'aria-label': 'Objects of the scene', change: () => this.choose()});
    private readonly count = element('p', {class: 'facts', role: 'status'});
    private objects: readonly SceneObject[] = [];
    private selected: SceneObject | null = null;

    /** `chosen` is called with null for the ball. */
    constructor(private readonly chosen: (object: SceneObject | null) => void) {
        this.element = element('div', {class: 'objects'}, labelled('Find an object', this.find), this.list, this.count);
    }

    show(objects: readonly SceneObject[]): void {
        this.objects = [...objects].sort((a, b) => a.name.localeCompare(b.name, 'en', {numeric: true}));
        this.fill();
    }

    /** Follows what was selected elsewhere. */
    select(object: SceneObject | null, isBall: boolean): void {
        this.selected = object;
        this.list.value = isBall ? 'ball' : String(this.objects.indexOf(object!));
    }

    private fill(): void {
        const word = this.find.value.trim().toLowerCase();
        const found = this.objects.map((object, i) => ({object, i}))
            .filter(({object: {name}}) => name.toLowerCase().includes(word));
        const options = found.map(({object: {name, isStatic}, i}) =>
            element('option', {value: i}, name + (isStatic ? '' : ' (moves)')));
        if ('ball'.includes(word)) options.unshift(element('option', {value: 'ball'}, 'Ball'));
        const value = this.list.value;
        this.list.replaceChildren(...options);
        this.list.value = this.selected === null ? value : String(this.objects.indexOf(this.selected));
        this.count.textContent = word === '' ? counted(this.objects.length, 'object') :
            `${found.length} of ${counted(this.objects.length, 'object')}`;
    }

    private choose(): void {
        const {value} = this.list;
        if (value !== '') this.chosen(value === 'ball' ? null : this.objects[Number(value)]);
    }
}
