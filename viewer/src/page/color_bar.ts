// SPDX-License-Identifier: Apache-2.0
import {ColorMap, cssGradient} from './color_maps';
import {element} from './dom';

/** A color map with numbers below it: `ticks` are evenly spaced from its low end to its high end. */
export function colorBar(map: ColorMap, caption: string, ticks: readonly string[]): HTMLElement {
    const bar = element('div', {class: 'bar'});
    bar.style.background = cssGradient(map, 32);
    return element('figure', {class: 'color-bar', role: 'group', 'aria-label': caption},
                   element('figcaption', {}, caption), bar,
                   element('div', {class: 'ticks'}, ...ticks.map(tick => element('span', {}, tick))));
}
