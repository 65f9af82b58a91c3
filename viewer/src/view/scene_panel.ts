// SPDX-License-Identifier: Apache-2.0
// What is shown, how bright, and the weights of layers.
import type {Volume} from 'tetralight';

import {isBaked} from '../light/volume';
import type {ProbeColor} from '../light/volume_marks';
import {StoredFile, titleOf} from '../page/api';
import {counted, countedTetrahedra} from '../page/colors';
import {button, checkbox, element, labelled, numberToSend, select, slider} from '../page/dom';
import {exposurePanel} from './exposure_panel';
import type {Part, Viewer} from './viewer';

const kParts: [Part, string][] = [['scene', 'Scene'], ['probes', 'Probes'], ['cells', 'All cells'],
                                    ['lightmaps', 'Lightmaps'], ['reflections', 'Reflections']];

export function scenePanel(viewer: Viewer): HTMLElement {
    const facts = element('p', {class: 'facts'});
    const parts = element('div', {class: 'checks'});
    const light = element('div');
    const size = element('div');
    const color = select([['light', 'Their light'], ['error', 'Error bars'], ['validity', 'Validity']],
                         viewer.marks.color, value => {
                             viewer.marks.color = value as ProbeColor;
                             viewer.stage.draw();
                         });

    const reflections = select([], '', id => void viewer.alerts.attempt('open', () => viewer.open.reflections(id))
                                                   .finally(() => showReflections(viewer, reflections)));
    const reflectionsRow = labelled('Reflection probes', reflections);
    const mirrorBalls = checkbox('Mirror balls at the reflection probes', false,
                                 isOn => viewer.reflections.showBalls(isOn));

    const show = () => {
        const shown = kParts.filter(([part]) => part === 'lightmaps' ? viewer.lightmaps !== null :
            part !== 'reflections' || viewer.reflections.file !== null);
        parts.replaceChildren(...shown.map(([part, text]) =>
            checkbox(text, !viewer.hidden.has(part), isOn => viewer.show(part, isOn))));
        color.value = viewer.marks.color;
        showReflections(viewer, reflections);
        reflectionsRow.hidden = reflections.options.length === 1;
        mirrorBalls.hidden = viewer.reflections.file === null;
        facts.textContent = viewer.volume === null ? 'No volume is open.' : factsOf(viewer.volume.probes);
        size.replaceChildren();
        if (viewer.marks.balls !== null) {
            const {balls} = viewer.marks;
            const usual = balls.radius;
            size.append(slider('Size of probes', {min: 0.2, max: 4, step: 0.1, value: 1}, factor => {
                balls.radius = usual * factor;
                viewer.stage.draw();
            }));
        }
        light.replaceChildren(...layerSliders(viewer));
    };
    viewer.onChange(show);
    viewer.reflections.onChange(show);
    show();

    return element('section', {'aria-label': 'View'}, facts, parts, reflectionsRow, mirrorBalls, exposurePanel(viewer.stage),
                   labelled('Probes show', color, 'Error bars: green 0.1 %, red 10 % and more.'), size,
                   element('h2', {}, 'Light'), light);
}

function factsOf(probes: Volume): string {
    return counted(probes.probeCount, 'probe') +
        (probes.probeCount < 4 ? '' : `, ${countedTetrahedra(probes.data.info.innerCellCount)}`) +
        (isBaked(probes) ? '' : '; not baked: bake it in the tab Bake');
}

/** The stored files to choose from, and the one that is open. */
function showReflections(viewer: Viewer, choice: HTMLSelectElement): void {
    const open = viewer.reflections.file;
    const files = viewer.reflections.files.filter(({state}) => state === 'ready');
    if (open !== null && !files.some(({id}) => id === open.id)) files.push(open);
    choice.replaceChildren(element('option', {value: ''}, 'none'),
                           ...files.map(file => element('option', {value: file.id}, titleOf(file))));
    choice.value = open?.id ?? '';
}

function layerSliders(viewer: Viewer): HTMLElement[] {
    const {volume} = viewer;
    if (volume === null || volume.probes.layers.length === 0) {
        return [element('p', {class: 'hint'}, 'Bake with layers (sun, sky, emission, …) to dim them here, ' +
                        'without another bake.')];
    }
    const rows = volume.probes.layers.map(({name, weight}) => slider(
        name, {min: 0, max: 4, step: 0.05, value: Number(weight.toPrecision(4))},
        changed => void viewer.alerts.attempt('weights', async () => viewer.relight({[name]: changed}))));
    const keep = button('Keep as a volume', () => void viewer.alerts.attempt('relight', () => keepLight(viewer)));
    if (volume.file.id !== '') rows.push(element('div', {class: 'buttons'}, keep));  // previews are not stored
    if (volume.file.facts?.has_transfer === true) rows.push(skyForm(viewer));
    return rows;
}

async function keepLight(viewer: Viewer): Promise<void> {
    const volume = viewer.volume!;
    const weights = Object.fromEntries(volume.probes.layers.map(({name, weight}) => [name, weight]));
    const made = await viewer.api.post<StoredFile>('/v1/relight', {volume: volume.file.id, weights});
    await viewer.open.volume(made.id);
    viewer.say('The light is stored as another volume.');
}

/** Another sun and sky for volumes with transfer. */
function skyForm(viewer: Viewer): HTMLElement {
    const azimuth = element('input', {type: 'number', step: 5, value: 30});
    const height = element('input', {type: 'number', step: 5, min: -90, max: 90, value: 45});
    const rotation = element('input', {type: 'number', step: 5, value: 0});
    const relight = async () => {
        const [a, h] = [azimuth, height].map(input => numberToSend(input) * Math.PI / 180);
        const made = await viewer.api.post<StoredFile>('/v1/relight', {
            volume: viewer.volume!.file.id,
            sky_rotation: numberToSend(rotation),
            sun_direction: [-Math.cos(h) * Math.sin(a), -Math.sin(h), -Math.cos(h) * Math.cos(a)],
        });
        await viewer.open.volume(made.id);
    };
    return element('fieldset', {}, element('legend', {}, 'Another sun and sky'),
                   labelled('Azimuth of the sun, degrees about +Y', azimuth), labelled('Elevation of the sun, degrees', height),
                   labelled('Rotation of the sky, degrees', rotation),
                   element('div', {class: 'buttons'},
                           button('Relight', () => void viewer.alerts.attempt('relight', relight))));
}
