// SPDX-License-Identifier: Apache-2.0
// How bright the view is, and how light becomes colour.
import {button, checkbox, element, labelled, select, slider} from '../page/dom';
import type {Stage} from './stage';
import {kToneMappings, nameOfTone, toneNamed} from './tone_mapping';

export function exposurePanel(stage: Stage): HTMLElement {
    const tone = select(kToneMappings.map(({name, text}) => [name, text]), nameOfTone(stage.toneMapping),
                        name => { stage.toneMapping = toneNamed(name); });
    const automatic = checkbox('Automatic: meter again when the camera moves', stage.isAutomatic, isOn => {
        stage.isAutomatic = isOn;
        if (isOn) void stage.exposeItself();
    });
    const controls = element('div');
    const show = () => {
        const facts = element('p', {class: 'hint'}, wordsOf(stage.stops));
        const value = Number(stage.stops.toFixed(1));
        controls.replaceChildren(
            slider('Exposure, stops', {min: -6, max: 6, step: 0.1, value}, stops => {
                stage.stops = stops;
                facts.textContent = wordsOf(stops);
            }),
            facts,
            element('div', {class: 'buttons'},
                    button('Reset exposure', () => stage.expose(stage.exposure / 2 ** stage.stops)),
                    button('Meter this view', () => void stage.exposeItself(0).then(isLit => {
                        if (!isLit) facts.textContent = 'Nothing in this view is lit: the exposure stays.';
                    }))));
        tone.value = nameOfTone(stage.toneMapping);
    };
    stage.exposed = show;
    show();
    const tones = labelled('Tone mapping', tone);
    tones.classList.add('wide');
    return element('div', {}, controls, automatic, tones);
}

function wordsOf(stops: number): string {
    const rounded = Number(Math.abs(stops).toFixed(1));
    if (rounded === 0) return 'As metered.';
    const times = Number((2 ** rounded).toPrecision(2));
    return `${times} times as ${stops > 0 ? 'bright' : 'dark'} as metered.`;
}
