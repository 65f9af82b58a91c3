// SPDX-License-Identifier: Apache-2.0
// What lights an object besides its probes, in words.
import type * as three from 'three';

import type {LightmapPlace} from '../light/lightmaps';
import {reflectionWeights} from '../light/reflections';
import {element} from '../page/dom';
import {lightGrid} from '../scene/object_light';
import {boxOf, SceneObject} from '../scene/scene_objects';
import type {Viewer} from '../view/viewer';

/** Terms and descriptions; nothing where nothing applies. */
export function objectFacts(viewer: Viewer, object: SceneObject, place: three.Vector3): HTMLElement {
    const rows: [string, string][] = [
        ['Proxy volume', proxyWords(object)], ['Lightmap', lightmapWords(viewer, object)],
        ['Reflection probe', reflectionWords(viewer, place)]];
    return element('dl', {class: 'facts'}, ...rows.filter(([, words]) => words !== '').flatMap(
        ([name, words]) => [element('dt', {}, name), element('dd', {}, words)]));
}

function proxyWords(object: SceneObject): string {
    if (!object.hasProxyVolume) return '';
    const size = boxOf(object).max.sub(boxOf(object).min).toArray().map(x => x.toFixed(1)).join(' × ');
    return `${size} m, ${lightGrid(object).resolution.join(' × ')} points`;
}

function lightmapWords(viewer: Viewer, object: SceneObject): string {
    const {model, lightmaps} = viewer;
    if (model === null || lightmaps === null || viewer.hidden.has('lightmaps')) return '';
    const place = model.lightmaps.placeOf(object.meshes);
    return place === null ? '' : rectangleWords(place);
}

/** The rectangle in shares of the page. */
export function rectangleWords({page, scale, offset}: LightmapPlace): string {
    const percent = (x: number) => `${(100 * x).toFixed(1)} %`;
    return `page ${page}, at ${percent(offset[0])}, ${percent(offset[1])}, size ${percent(scale[0])} × ${percent(scale[1])}`;
}

function reflectionWords(viewer: Viewer, place: three.Vector3): string {
    const mirror = viewer.reflections.mirror;
    if (mirror === null) return '';
    const parts = reflectionWeights(mirror.probes, place.toArray()).map(
        ({probe, weight}) => `${mirror.probes[probe].name || `probe ${probe}`}: ${(100 * weight).toFixed(0)} %`);
    return parts.length === 0 ? 'none here' : parts.join(', ');
}
