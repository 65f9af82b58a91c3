// SPDX-License-Identifier: Apache-2.0
// Words at places of the scene. Screen readers have them in the panel.
import type * as three from 'three';

import {element} from '../page/dom';
import type {Stage} from './stage';

export interface Label {
    text: string;
    at: three.Vector3;
}

export class Labels {
    private readonly layer = element('div', {class: 'labels', 'aria-hidden': 'true'});
    private readonly groups = new Map<string, {label: Label; element: HTMLElement}[]>();

    constructor(private readonly stage: Stage, private readonly areShown: () => boolean) {
        stage.parent.append(this.layer);
        stage.drawn.push(() => this.place());
    }

    /** Replaces the labels of a group. */
    show(group: string, labels: readonly Label[]): void {
        for (const {element: old} of this.groups.get(group) ?? []) old.remove();
        const made = labels.map(label => ({label, element: element('span', {class: `label ${group}`}, label.text)}));
        this.layer.append(...made.map(one => one.element));
        this.groups.set(group, made);
        this.place();
    }

    private place(): void {
        this.layer.hidden = !this.areShown();
        const all = [...this.groups.values()].flat();
        if (all.length === 0) return;
        const box = this.stage.canvas.getBoundingClientRect();
        const places = all.map(({label}) => this.stage.pageFrom(label.at));  // all is read before anything is written
        all.forEach(({element: one}, i) => {
            const {x, y, isInFront} = places[i];
            one.hidden = !isInFront;
            one.style.transform = `translate(${Math.round(x - box.left)}px, ${Math.round(y - box.top)}px)`;
        });
    }
}
