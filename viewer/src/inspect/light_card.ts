// SPDX-License-Identifier: Apache-2.0
// The light at a place: a swatch, where it comes from, its cell, its probes and weights, and its numbers.
import {irradiance, Light, Volume} from 'tetralight';
import type * as three from 'three';

import {sourceWords} from '../light/light_sources';
import type {OpenVolume} from '../light/volume';
import {formatPercent} from '../page/colors';
import {button, element} from '../page/dom';
import type {Stage} from '../view/stage';
import {LightSwatch} from './light_swatch';

const kDirections: [string, number[]][] = [
    ['above', [0, 1, 0]], ['below', [0, -1, 0]], ['+X', [1, 0, 0]], ['−X', [-1, 0, 0]], ['+Z', [0, 0, 1]], ['−Z', [0, 0, -1]]];

export interface ProbeActions {
    select(probe: number): void;
    /** The probe that has the focus or the pointer, or -1. */
    point(probe: number): void;
}

export class LightCard {
    readonly element: HTMLElement;
    private readonly swatch = new LightSwatch();
    private readonly sources = element('p', {class: 'facts'});
    private readonly answer = element('div', {class: 'answer'});
    private readonly numbers = element('tbody');
    private readonly words = element('p', {class: 'facts'});
    private readonly details: HTMLDetailsElement;
    private light: Light | null = null;
    private seen = '';  // the view that the swatch is of
    private rows: HTMLElement[] = [];

    constructor(private readonly stage: Stage, private readonly actions: ProbeActions) {
        const head = ['From', 'Red', 'Green', 'Blue'].map(name => element('th', {scope: 'col'}, name));
        this.details = element(
            'details', {toggle: () => this.showNumbers()}, element('summary', {}, 'Light in numbers'),
            element('table', {}, element('caption', {}, 'Irradiance over π, on a surface that faces'),
                    element('thead', {}, element('tr', {}, ...head)), this.numbers), this.words);
        this.element = element('div', {}, this.swatch.element, this.sources, this.answer, this.details);
    }

    /** `place` is where the light is. */
    show(light: Light, place: three.Vector3, volume: OpenVolume): void {
        this.light = light;
        this.seen = '';
        this.followView();
        this.sources.textContent = sourceWords(volume.probes, light);
        this.showProbes(light, place, volume);
        this.showNumbers();
    }

    /** Shows the light as the view does, if the view has changed. */
    followView(): void {
        const {camera, exposure, toneMapping} = this.stage;
        const seen = [...camera.quaternion.toArray(), exposure, toneMapping].join(' ');
        if (this.light === null || this.element.hidden || seen === this.seen) return;
        this.seen = seen;
        this.swatch.show(this.light.sh, this.stage);
    }

    private showProbes({cell, probes, weights}: Light, place: three.Vector3, volume: OpenVolume): void {
        const focused = this.rows.findIndex(row => row.contains(document.activeElement));
        this.rows = probes.map((probe, i) => {
            const [x, y, z] = volume.probes.position(probe);
            const distance = Math.hypot(x - place.x, y - place.y, z - place.z);
            const link = button(`probe ${probe}`, () => this.actions.select(probe), {
                class: 'link', title: probeWords(volume, probe),
                focus: () => this.actions.point(probe), blur: () => this.actions.point(-1),
                pointerenter: () => this.actions.point(probe), pointerleave: () => this.actions.point(-1),
            });
            return element('tr', {}, element('td', {}, link), element('td', {class: 'distance'}, `${distance.toFixed(1)} m`),
                           element('td', {class: 'number'}, weights[i].toFixed(3)), element('td', {}, meter(weights[i])));
        });
        const head = ['Probe', 'Distance', 'Weight', 'Fraction'].map(name => element('th', {scope: 'col'}, name));
        this.answer.replaceChildren(
            element('h3', {}, cellWords(cell, probes, volume.probes)),
            element('table', {}, element('caption', {}, 'Its probes'), element('thead', {}, element('tr', {}, ...head)),
                    element('tbody', {}, ...this.rows)));
        if (focused >= 0) this.rows[focused]?.querySelector('button')?.focus();
    }

    private showNumbers(): void {
        if (!this.details.open || this.light === null) return;
        const {sh, occlusion, ambient} = this.light;
        this.numbers.replaceChildren(...kDirections.map(([name, normal]) => element(
            'tr', {}, element('th', {scope: 'row'}, name),
            ...irradiance(sh, normal).map(x => element('td', {class: 'number'}, (x / Math.PI).toFixed(3))))));
        this.words.textContent = `Occlusion, four channels: ${[...occlusion].map(x => x.toFixed(2)).join(', ')}.` +
            (ambient > 0 ? ` Ambient light: ${formatPercent(ambient)}.` : '');
    }
}

function cellWords(cell: number, probes: readonly number[], {data: {info}}: Volume): string {
    if (probes.length === 0) return 'No cell: ambient light';
    return `${cell < info.innerCellCount ? 'Cell' : 'Hull cell'} ${cell}`;
}

/** "probe 90, validity 1, error 1.2 %". */
export function probeWords({probes, health}: OpenVolume, probe: number): string {
    const {validity} = probes.data;
    return [`probe ${probe}`, validity.length === 0 ? '' : `validity ${Number(validity[probe].toFixed(2))}`,
            health.length === 0 ? '' : `error ${formatPercent(health[probe].error)}`].filter(words => words !== '').join(', ');
}

function meter(share: number): HTMLElement {
    const made = element('meter', {min: 0, max: 1, 'aria-label': 'Weight'});
    made.value = Math.max(0, Math.min(1, share));
    return made;
}
