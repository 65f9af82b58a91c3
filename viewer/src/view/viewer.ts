// SPDX-License-Identifier: Apache-2.0
// What the page shows: one scene, one volume, and the light that the volume has at these weights.
import type {LayerWeights, Lightmaps} from 'tetralight';
import * as three from 'three';

import type {OtherLight} from '../light/other_light';
import type {OpenVolume} from '../light/volume';
import {VolumeMarks} from '../light/volume_marks';
import type {Alerts} from '../page/alerts';
import type {Api, Bake, StoredFile} from '../page/api';
import {ProbeLight} from '../scene/probe_light';
import {SceneLights} from '../scene/scene_lights';
import {disposeScene, loadScene, SceneModel} from '../scene/scene_model';
import type {Shown} from '../scene/shown';
import {exposureOfProbes} from './exposure';
import {FileOpener} from './file_opener';
import {Gizmo} from './gizmo';
import {ShownReflections} from './shown_reflections';
import type {Stage} from './stage';

export type Part = 'scene' | 'probes' | 'cells' | 'lightmaps' | 'reflections';

/** What is shown only when it is asked for. */
export const kOffAtFirst: readonly Part[] = ['cells'];

const kManyEdges = 30000;  // probes; drawing all their edges is slow

export class Viewer implements Shown {
    volume: OpenVolume | null = null;
    /** Of the volume, if it is known. */
    bake: Bake | null = null;
    model: SceneModel | null = null;
    sceneFile: StoredFile | null = null;
    /** The bake or the lightmaps whose UVs the scene has; empty: it has its own. */
    unwrappedFor = '';
    /** Those on the scene. */
    lightmaps: Lightmaps | null = null;
    readonly hidden = new Set<Part>(kOffAtFirst);
    readonly open = new FileOpener(this);
    readonly marks = new VolumeMarks();
    readonly probeLight = new ProbeLight(this);
    readonly reflections: ShownReflections;
    readonly gizmo: Gizmo;
    private readonly lights: SceneLights;
    private isEditingNow = false;
    private isComparingNow = false;
    private readonly listeners: (() => void)[] = [];
    private readonly lightListeners: (() => void)[] = [];
    private readonly pageListeners: (() => void)[] = [];
    private readonly selectionListeners: (() => void)[] = [];

    constructor(readonly api: Api, readonly stage: Stage,
                readonly alerts: Alerts, readonly say: (news: string) => void) {
        this.gizmo = new Gizmo(stage);
        this.reflections = new ShownReflections(this, stage);
        this.lights = new SceneLights(this, stage.scene, stage.sky.radiance);
        stage.scene.add(this.marks.group);
    }

    /** Called when there is another volume or scene. */
    onChange(listener: () => void): void {
        this.listeners.push(listener);
    }

    /** Called when the light of probes is another. */
    onLight(listener: () => void): void {
        this.lightListeners.push(listener);
    }

    /** Called when the pages of lightmaps are others. */
    onPages(listener: () => void): void {
        this.pageListeners.push(listener);
    }

    /** Called when another probe is selected. */
    onSelect(listener: () => void): void {
        this.selectionListeners.push(listener);
    }

    changed(): void {
        for (const listener of this.listeners) listener();
        this.applyParts();
    }

    showVolume(volume: OpenVolume, bake: Bake | null): void {
        const hadNothing = this.volume === null && this.model === null;
        this.volume = volume;
        this.bake = bake;
        this.marks.show(volume);
        if (volume.probes.probeCount > kManyEdges) this.hidden.add('cells');
        this.applyParts();
        if (hadNothing) this.stage.lookAtAll(this.box);
        this.lights.choose();
        this.changed();
        this.showLight();
        this.placeLight();
    }

    closeVolume(): void {
        this.volume = null;
        this.bake = null;
        this.marks.show(null);
        this.placeLight();
        this.lights.choose();
        this.changed();
    }

    /** Shows a scene; the camera stays if it is the one that is shown already, with other UVs. */
    async showScene(file: StoredFile, bytes: ArrayBuffer, unwrappedFor = ''): Promise<void> {
        const model = await loadScene(bytes, this.probeLight.field.uniforms);
        const isKnown = this.sceneFile?.id === file.id;
        this.dropScene();
        this.model = model;
        this.sceneFile = file;
        this.unwrappedFor = unwrappedFor;
        this.stage.scene.add(model.root);
        this.reflections.apply();
        if (!isKnown) this.stage.lookAtAll(model.box);
        if (!isKnown && model.view !== null) this.stage.look(model.view.eye, model.view.target);
        this.lights.choose();
        this.placeLight();
    }

    closeScene(): void {
        this.dropScene();
        this.changed();
    }

    private dropScene(): void {
        if (this.model !== null) {
            this.model.root.removeFromParent();
            this.model.lightmaps.dispose();
            for (const mover of this.model.movers) mover.dispose();
            disposeScene(this.model.root);
        }
        this.model = null;
        this.sceneFile = null;
        this.unwrappedFor = '';
        if (this.lightmaps !== null) this.setPages(null);
    }

    /** Shows lightmaps on the scene, which has their UVs. */
    showLightmaps(lightmaps: Lightmaps): void {
        const hadPages = this.lightmaps !== null;
        this.model!.lightmaps.setPages(lightmaps);
        this.setPages(lightmaps);
        if (!hadPages) this.changed();
        this.stage.draw();
    }

    private setPages(lightmaps: Lightmaps | null): void {
        this.lightmaps = lightmaps;
        for (const listener of this.pageListeners) listener();
    }

    /** The bounding box of the scene and the probes. */
    get box(): three.Box3 {
        const box = this.model?.box.clone() ?? new three.Box3();
        if (this.volume !== null) box.union(new three.Box3().setFromArray(this.volume.positions));
        return box.isEmpty() ? new three.Box3(new three.Vector3(-1, -1, -1), new three.Vector3(1, 1, 1)) : box;
    }

    /** Changes weights of layers; probes, scene and everything that shows the light follow. */
    relight(changes: LayerWeights): void {
        this.volume?.probes.setWeights(changes);
        this.showLight();
    }

    /** The weights that are not those of the stored volume. */
    get changedWeights(): LayerWeights {
        if (this.volume === null) return {};
        const {layers, data} = this.volume.probes;
        const changed = layers.filter(({weight}, i) => weight !== data.layers[i].weight);
        return Object.fromEntries(changed.map(({name, weight}) => [name, weight]));
    }

    private showLight(): void {
        if (this.volume === null) return;
        const {irradiance} = this.volume.probes;
        this.marks.balls!.setLight(irradiance);
        this.stage.guess(exposureOfProbes(irradiance));
        this.probeLight.relight();
        this.lights.dim();
        this.stage.draw();
        for (const listener of this.lightListeners) listener();
    }

    private placeLight(): void {
        this.probeLight.place();
        this.stage.draw();
    }

    /** Draws once with the scene lit by another light; `null`: as it is. */
    drawBy(other: OtherLight | null, draw: () => void): void {
        if (other === null) draw();
        else this.lights.drawBy(other, () => this.probeLight.drawBy(other, draw));
    }

    show(part: Part, isShown: boolean): void {
        if (isShown) this.hidden.delete(part);
        else this.hidden.add(part);
        this.applyParts();
        if (part === 'reflections') this.reflections.turnOn(isShown);
    }

    /** While groups are edited, their probes and cells are shown in place of the volume's. */
    set isEditing(isEditing: boolean) {
        this.isEditingNow = isEditing;
        this.applyParts();
    }

    /** Comparisons are of the light of probes: lightmaps rest, and probes and cells are not in the way. */
    set isComparing(isComparing: boolean) {
        if (isComparing === this.isComparingNow) return;
        this.isComparingNow = isComparing;
        this.applyParts();
    }

    private applyParts(): void {
        const areMarksShown = !this.isEditingNow && !this.isComparingNow;
        if (this.model !== null) this.model.root.visible = !this.hidden.has('scene');
        this.model?.lightmaps.use(!this.isComparingNow && !this.hidden.has('lightmaps'));
        this.lights.followScene();
        this.marks.showParts({
            probes: areMarksShown && !this.hidden.has('probes'), cells: areMarksShown && !this.hidden.has('cells'),
            ring: !this.isEditingNow, others: areMarksShown,
        });
        this.stage.draw();
    }

    /** Marks a probe, and looks at it. */
    selectProbe(probe: number, isLooked = true): void {
        this.marks.select(probe);
        this.applyParts();
        for (const listener of this.selectionListeners) listener();
        if (this.volume === null || probe < 0 || !isLooked) return;
        const at = new three.Vector3().fromArray(this.volume.positions, 3 * probe);
        const {camera, controls} = this.stage;
        const away = camera.position.clone().sub(controls.target);
        away.setLength(Math.min(away.length(), 30 * this.marks.balls!.radius));
        this.stage.look(at.clone().add(away).toArray(), at.toArray());
    }
}
