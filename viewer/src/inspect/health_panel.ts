// SPDX-License-Identifier: Apache-2.0
// How far each probe can be trusted; a click finds it in 3D.
import type {OpenVolume} from '../light/volume';
import {formatPercent} from '../page/colors';
import {button, element, labelled, select} from '../page/dom';
import type {Viewer} from '../view/viewer';

const kRows = 200;
type Order = 'error' | 'validity' | 'surface' | 'probe';

export function healthPanel(viewer: Viewer): HTMLElement {
    let order: Order = 'error';
    const body = element('tbody');
    const facts = element('p', {class: 'facts'});
    const show = () => {
        const {volume} = viewer;
        if (volume === null || volume.health.length === 0) {
            facts.textContent = volume === null ? 'No volume is open.' : 'The volume has no error bars: it was not baked.';
            body.replaceChildren();
            return;
        }
        const probes = sorted(volume, order).slice(0, kRows);
        facts.textContent = volume.probes.probeCount > kRows ? `The first ${kRows} of ${volume.probes.probeCount}.` : '';
        body.replaceChildren(...probes.map(probe => row(viewer, volume, probe)));
    };
    viewer.onChange(show);
    viewer.onSelect(() => {
        for (const shown of body.rows) mark(shown, viewer.marks.selectedProbe);
    });
    show();
    const first = select([['error', 'the largest error'], ['validity', 'the least validity'],
                          ['surface', 'the nearest surface'], ['probe', 'the lowest number']], order, value => {
        order = value as Order;
        show();
    });
    return element('section', {'aria-label': 'Health'}, labelled('First', first), facts,
                   element('div', {class: 'scroll', tabindex: 0, role: 'region', 'aria-label': 'Probe health'},
                           element('table', {}, element('caption', {}, 'Probe health'),
                                   element('thead', {}, element('tr', {}, ...[
                                       'Probe', 'Error', 'Validity', 'Surface', 'Offset'].map(
                                       name => element('th', {scope: 'col'}, name)))), body)));
}

export function sorted({health, probes: {data: {validity}}}: OpenVolume, order: Order): number[] {
    const probes = [...health.keys()];
    const key: Record<Order, (probe: number) => number> = {
        error: probe => -health[probe].error,
        validity: probe => validity[probe] ?? 1,
        surface: probe => health[probe].surface,
        probe: probe => probe,
    };
    return probes.sort((a, b) => key[order](a) - key[order](b) || a - b);
}

function mark(shown: HTMLTableRowElement, selected: number): void {
    if (Number(shown.dataset.probe) === selected) shown.setAttribute('aria-current', 'true');
    else shown.removeAttribute('aria-current');
}

function row(viewer: Viewer, volume: OpenVolume, probe: number): HTMLElement {
    const {error, surface, offset, isDilated} = volume.health[probe];
    const distance = Math.hypot(...offset);
    const number = (text: string) => element('td', {class: 'number'}, text);
    const made = element('tr', {'data-probe': probe},
                   element('td', {}, button(String(probe), () => viewer.selectProbe(probe),
                                            {class: 'link', 'aria-label': `Show probe ${probe}`})),
                   number(formatPercent(error)),
                   number((volume.probes.data.validity[probe] ?? 1).toFixed(2)),
                   number(Number.isFinite(surface) ? `${surface.toFixed(2)} m` : '–'),
                   number(isDilated ? 'dilated' : distance > 0 ? `${distance.toFixed(2)} m` : '–'));
    mark(made, viewer.marks.selectedProbe);
    return made;
}
