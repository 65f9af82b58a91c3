// SPDX-License-Identifier: Apache-2.0
// What the page shows as a link, and the page as a link says.
import * as three from 'three';

import {comparisonFromLink, linkOfComparison} from './compare/compare_link';
import type {Comparison} from './compare/comparison';
import type {InspectPanel} from './inspect/inspect_panel';
import type {ProbeColor} from './light/volume_marks';
import {openOrExplain, WayOn} from './page/gone';
import type {Tabs} from './page/tabs';
import {toLink, ViewState} from './page/view_link';
import {nameOfTone, toneNamed} from './view/tone_mapping';
import {kOffAtFirst, Part, Viewer} from './view/viewer';

/** The parts of the page that a link holds. */
export interface LinkedParts {
    viewer: Viewer;
    inspect: InspectPanel;
    comparison: Comparison;
    tabs: Tabs;
}

export function linkOf({viewer, viewer: {stage}, inspect, comparison, tabs}: LinkedParts): string {
    return toLink({
        volume: viewer.volume?.file.id,
        scene: viewer.sceneFile?.id,
        reflections: viewer.reflections.file?.id,
        tab: tabs.current,
        eye: stage.camera.position.toArray(),
        target: stage.controls.target.toArray(),
        object: viewer.volume === null ? undefined : inspect.ball.position,
        exposure: Number(stage.exposure.toPrecision(4)),
        stops: Number(stage.stops.toFixed(1)),
        tone: stage.toneMapping === toneNamed(undefined) ? '' : nameOfTone(stage.toneMapping),
        hidden: [...viewer.hidden].filter(part => !kOffAtFirst.includes(part)),
        shown: kOffAtFirst.filter(part => !viewer.hidden.has(part)),
        color: viewer.marks.color === 'light' ? '' : viewer.marks.color,
        weights: viewer.changedWeights,
        ...linkOfComparison(comparison.state),
    });
}

export interface Fallbacks {
    /** The newest stored file that can be opened, if any. */
    newest(kind: 'scenes' | 'volumes'): Promise<string | undefined>;
    /** Offered if the server does not have what the link names. */
    way: WayOn;
}

/** Opens what the link names, and else the newest. */
export async function openLink({viewer, viewer: {stage}, inspect, comparison, tabs}: LinkedParts, link: ViewState,
                               fallbacks: Fallbacks): Promise<void> {
    applyLook(viewer, link);
    await openFiles(viewer, link, fallbacks);
    if (link.eye !== undefined && link.target !== undefined) stage.look(link.eye, link.target);
    if (link.object === undefined) inspect.ball.place();
    else inspect.ball.moveTo(new three.Vector3(...link.object));
    if (link.exposure === undefined) await stage.exposeItself();
    await comparison.set(comparisonFromLink(link));
    if (link.tab !== undefined) tabs.open(link.tab);
}

/** Exposure, tone mapping, and which parts are shown. */
function applyLook(viewer: Viewer, {exposure, stops, tone, hidden = [], shown = [], color}: ViewState): void {
    if (exposure !== undefined) viewer.stage.expose(exposure, stops);
    viewer.stage.toneMapping = toneNamed(tone);
    for (const part of hidden) viewer.show(part as Part, false);
    for (const part of shown) viewer.show(part as Part, true);
    if (color !== undefined) viewer.marks.color = color as ProbeColor;
}

async function openFiles(viewer: Viewer, link: ViewState, {newest, way}: Fallbacks): Promise<void> {
    const {alerts, open} = viewer;
    if (link.scene !== undefined) open.fetchScene(link.scene).catch(() => {});
    const volume = link.volume ?? await newest('volumes');
    if (volume !== undefined) {
        await alerts.attempt('open', () => openOrExplain('volume', volume, () => open.volume(volume, link.weights), way));
    }
    const scene = link.scene ?? (viewer.sceneFile === null ? await newest('scenes') : undefined);
    if (scene !== undefined) {
        await alerts.attempt('open scene', () => openOrExplain('scene', scene, () => open.scene(scene), way));
    }
    const {reflections} = link;
    if (reflections !== undefined) await alerts.attempt('open', () => open.reflections(reflections));
}
