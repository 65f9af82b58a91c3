// SPDX-License-Identifier: Apache-2.0
// What is shown, how bright, and the weights of layers.
import type {Volume} from 'tetralight';

import {StoredFile, titleOf} from './api';
import {counted, countedTetrahedra} from './colors';
import {button, checkbox, element, labelled, numberToSend, select, slider} from './dom';
import type {Stage} from './stage';
import type {Part, ProbeColor, Viewer} from './viewer';
import {isBaked} from './volume';

const kParts: [Part, string][] = [['scene', 'Scene'], ['probes', 'Probes'], ['cells', 'Cells and hull'],
                                    ['lightmaps', 'Lightmaps'], ['reflections', 'Reflections']];

export function scenePanel(viewer: Viewer): HTMLElement {
    const facts = element('p', {class: 'facts'});
    const parts = element('div', {class: 'checks'});
    const light = element('div');
    const size = element('div');
    const color = select([['light', 'Their light'], ['error', 'Error bars'], ['validity', 'Validity']],
                         viewer.color, value => viewer.setColor(value as ProbeColor));

    const reflections = select([], '', id => void viewer.alerts.attempt('open', () => viewer.openReflections(id))
                                                   .finally(() => showReflections(viewer, reflections)));
    const reflectionsRow = labelled('Reflection probes', reflections);

    const show = () => {
        const shown = kParts.filter(([part]) => part === 'lightmaps' ? viewer.hasLightmaps :
            part !== 'reflections' || viewer.reflectionFile !== null);
        parts.replaceChildren(...shown.map(([part, text]) =>
            checkbox(text, !viewer.hidden.has(part), isOn => viewer.show(part, isOn))));
        color.value = viewer.color;
        showReflections(viewer, reflections);
        reflectionsRow.hidden = reflections.options.length === 1;
        facts.textContent = viewer.volume === null ? 'No volume is open.' : factsOf(viewer.volume.probes);
        size.replaceChildren();
        if (viewer.balls !== null) {
            const {balls} = viewer;
            const usual = balls.radius;
            size.append(slider('Size of probes', {min: 0.2, max: 4, step: 0.1, value: 1}, factor => {
                balls.radius = usual * factor;
                viewer.stage.draw();
            }));
        }
        light.replaceChildren(...layerSliders(viewer));
    };
    viewer.onChange(show);
    viewer.onReflections(show);
    show();

    return element('section', {'aria-label': 'View'}, facts, parts, reflectionsRow, exposureSlider(viewer.stage),
                   labelled('Probes show', color, 'Error bars: green 0.1 %, red 10 % and more.'), size,
                   element('h2', {}, 'Light'), light);
}

function factsOf(probes: Volume): string {
    return counted(probes.probeCount, 'probe') +
        (probes.probeCount < 4 ? '' : `, ${countedTetrahedra(probes.data.info.innerCellCount)}`) +
        (isBaked(probes) ? '' : '; not baked: bake it in the tab Bakes');
}

/** The stored files to choose from, and the one that is open. */
function showReflections(viewer: Viewer, choice: HTMLSelectElement): void {
    const open = viewer.reflectionFile;
    const files = viewer.reflectionFiles.filter(({state}) => state === 'ready');
    if (open !== null && !files.some(({id}) => id === open.id)) files.push(open);
    choice.replaceChildren(element('option', {value: ''}, 'none'),
                           ...files.map(file => element('option', {value: file.id}, titleOf(file))));
    choice.value = open?.id ?? '';
}

function exposureSlider(stage: Stage): HTMLElement {
    const made = element('div');
    const show = () => {
        const value = Number(Math.log2(stage.exposure).toFixed(1));
        made.replaceChildren(
            slider('Exposure, stops', {min: -12, max: 12, step: 0.1, value}, stops => { stage.exposure = 2 ** stops; }),
            element('div', {class: 'buttons'}, button('Expose for this view', () => stage.exposeItself())));
    };
    stage.exposed = show;
    show();
    return made;
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
    rows.push(element('div', {class: 'buttons'}, keep));
    if (volume.file.facts?.has_transfer === true) rows.push(skyForm(viewer));
    return rows;
}

async function keepLight(viewer: Viewer): Promise<void> {
    const volume = viewer.volume!;
    const weights = Object.fromEntries(volume.probes.layers.map(({name, weight}) => [name, weight]));
    const made = await viewer.api.post<StoredFile>('/v1/relight', {volume: volume.file.id, weights});
    await viewer.openVolume(made.id);
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
        await viewer.openVolume(made.id);
    };
    return element('fieldset', {}, element('legend', {}, 'Another sun and sky'),
                   labelled('Azimuth of the sun, degrees about +Y', azimuth), labelled('Elevation of the sun, degrees', height),
                   labelled('Rotation of the sky, degrees', rotation),
                   element('div', {class: 'buttons'},
                           button('Relight', () => void viewer.alerts.attempt('relight', relight))));
}
