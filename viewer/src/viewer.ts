// SPDX-License-Identifier: Apache-2.0
// What the page shows: one scene, one volume, and the light that the volume has at these weights.
import {LayerWeights, Lightmaps, readLightmaps, readReflections} from 'tetralight';
import * as three from 'three';

import type {Alerts} from './alerts';
import {Api, ApiError, Bake, StoredFile} from './api';
import {edgesOf} from './cell_edges';
import {CellLines} from './cell_lines';
import {badnessColor, errorBadness} from './colors';
import {Gizmo} from './gizmo';
import {gridOf, LightField} from './light_field';
import {hideMirror, Mirror} from './mirror';
import {ProbeBalls} from './probe_balls';
import {disposeScene, loadScene, SceneModel} from './scene_model';
import type {Stage} from './stage';
import {isBaked, openVolume, OpenVolume, skyOf} from './volume';
import {dimLights, directLights, dropLights, makeLights} from './volume_lights';

export type ProbeColor = 'light' | 'validity' | 'error';
export type Part = 'scene' | 'probes' | 'cells' | 'lightmaps' | 'reflections';

const kManyEdges = 30000;  // probes; drawing all their edges is slow

export class Viewer {
    volume: OpenVolume | null = null;
    model: SceneModel | null = null;
    sceneFile: StoredFile | null = null;
    bake: Bake | null = null;
    balls: ProbeBalls | null = null;
    color: ProbeColor = 'light';
    selectedProbe = -1;
    readonly hidden = new Set<Part>();
    readonly field = new LightField();
    readonly lines = new CellLines();
    readonly gizmo: Gizmo;
    private lights = new three.Group();  // of the volume
    private readonly marker = new three.Mesh(  // seen through walls
        new three.TorusGeometry(1.6, 0.16, 8, 48),
        new three.MeshBasicMaterial({color: 0xffc000, depthTest: false, transparent: true, toneMapped: false}));
    private readonly selectionListeners: (() => void)[] = [];
    private readonly listeners: (() => void)[] = [];
    private readonly lightListeners: (() => void)[] = [];
    /** The stored files, and the one that surfaces mirror. */
    reflectionFiles: StoredFile[] = [];
    reflectionFile: StoredFile | null = null;
    private mirror: Mirror | null = null;
    private readonly mirrorListeners: (() => void)[] = [];
    private hasEdges = false;
    private isHandedOver = false;
    private litBy = '';  // the bake or the lightmaps that the UVs of the scene are of

    constructor(readonly api: Api, readonly stage: Stage,
                readonly alerts: Alerts, readonly say: (news: string) => void) {
        this.gizmo = new Gizmo(stage);
        this.marker.renderOrder = 10;
        this.marker.onBeforeRender = (_, __, camera) => {
            this.marker.quaternion.copy(camera.quaternion);
            this.marker.updateMatrixWorld();
            this.marker.modelViewMatrix.multiplyMatrices(camera.matrixWorldInverse, this.marker.matrixWorld);
        };
        stage.scene.add(this.lines.group, this.marker);
    }

    /** Called when there is another volume or scene. */
    onChange(listener: () => void): void {
        this.listeners.push(listener);
    }

    /** Called when another probe is selected. */
    onSelect(listener: () => void): void {
        this.selectionListeners.push(listener);
    }

    /** Called when the light of probes is another. */
    onLight(listener: () => void): void {
        this.lightListeners.push(listener);
    }

    /** Called when there are other files of reflection probes, or surfaces mirror others. */
    onReflections(listener: () => void): void {
        this.mirrorListeners.push(listener);
    }

    /** Opens a volume with the scene of its bake, when that is known. */
    async openVolume(reference: string, weights: LayerWeights = {}): Promise<void> {
        const [file, {bakes}] = await Promise.all([
            this.api.get<StoredFile>(`/v1/volumes/${encodeURIComponent(reference)}`),
            this.api.get<{bakes: Bake[]}>('/v1/bakes')]);
        if (file.state === 'quarantined') {
            throw new ApiError(422, 'damaged', `the volume ${file.name || file.id} is damaged: ${file.damage}`);
        }
        const bake = bakes.find(each => each.volume === file.id) ?? null;
        const scene = bake?.request?.scene as string | undefined;
        this.alerts.succeed('scene');
        const [volume] = await Promise.all([
            openVolume(this.api, file),
            scene === undefined ? null : this.alerts.attempt('scene', () => this.openScene(scene))]);
        const known = Object.entries(weights).filter(([name]) => volume.probes.layers.some(layer => layer.name === name));
        if (known.length > 0) volume.probes.setWeights(Object.fromEntries(known));
        this.bake = bake;
        this.showVolume(volume);
        this.placeField();
    }

    closeVolume(): void {
        this.volume = null;
        this.balls?.dispose();
        this.balls = null;
        this.lines.clear();
        this.field.clear();
        this.bake = null;
        this.lightScene();
        this.changed();
    }

    async openScene(reference: string): Promise<void> {
        const file = await this.api.get<StoredFile>(`/v1/scenes/${encodeURIComponent(reference)}`);
        if (this.sceneFile?.id !== file.id) {
            await this.showScene(file, await this.api.bytes(`/v1/scenes/${file.id}/file`));
        }
        this.changed();
    }

    /** Shows a scene; the camera stays if it is the one that is shown already, with other UVs. */
    private async showScene(file: StoredFile, bytes: ArrayBuffer): Promise<void> {
        const model = await loadScene(bytes, this.field.uniforms);
        const isKnown = this.sceneFile?.id === file.id;
        this.dropScene();
        this.model = model;
        this.sceneFile = file;
        this.stage.scene.add(model.root);
        this.applyMirror();
        if (!isKnown) this.stage.lookAtAll(model.box);
        if (!isKnown && model.view !== null) this.stage.look(model.view.eye, model.view.target);
        this.lightScene();
        this.placeField();
    }

    /** Shows the newest preview of a bake of lightmaps on its scene. */
    async showPreview(bake: string, scene: string): Promise<void> {
        const path = `/v1/bakes/${bake}/preview`;
        const lightmaps = readLightmaps(await this.api.bytes(`${path}/file`));
        await this.showLightmaps(bake, scene, lightmaps, () => this.api.bytes(`${path}/scene`));
    }

    /** Shows stored lightmaps on their scene; `bake` made them. */
    async openLightmaps(id: string, scene: string, bake = id): Promise<void> {
        const lightmaps = readLightmaps(await this.api.bytes(`/v1/lightmaps/${id}/file`));
        await this.showLightmaps(bake, scene, lightmaps, () => this.api.make(`/v1/lightmaps/${id}/export`, {scene}));
    }

    private async showLightmaps(origin: string, scene: string, lightmaps: Lightmaps,
                                unwrapped: () => Promise<ArrayBuffer>): Promise<void> {
        if (this.litBy !== origin) {
            const [file, bytes] = await Promise.all(
                [this.api.get<StoredFile>(`/v1/scenes/${encodeURIComponent(scene)}`), unwrapped()]);
            await this.showScene(file, bytes);
            this.litBy = origin;
        }
        const hadPages = this.hasLightmaps;
        this.model!.lightmaps.setPages(lightmaps);
        if (!hadPages) this.changed();
        this.stage.draw();
    }

    get hasLightmaps(): boolean {
        return this.model?.lightmaps.hasPages ?? false;
    }

    /** Surfaces mirror stored reflection probes; '' shows none. */
    async openReflections(reference: string): Promise<void> {
        const path = `/v1/reflections/${encodeURIComponent(reference)}`;
        const file = reference === '' ? null : await this.api.get<StoredFile>(path);
        const mirror = file === null ? null : new Mirror(readReflections(await this.api.bytes(`${path}/file`)));
        this.mirror?.dispose();
        this.mirror = mirror;
        this.reflectionFile = file;
        this.applyMirror();
        for (const listener of this.mirrorListeners) listener();
    }

    setReflectionFiles(files: StoredFile[]): void {
        this.reflectionFiles = files;
        for (const listener of this.mirrorListeners) listener();
    }

    /** What surfaces mirror now. */
    get shownMirror(): Mirror | null {
        return this.hidden.has('reflections') ? null : this.mirror;
    }

    private applyMirror(): void {
        const mirror = this.shownMirror;
        for (const surface of this.model?.surfaces ?? []) {
            if (mirror === null) hideMirror(surface.material);
            else mirror.showOn(surface);
        }
        this.stage.draw();
    }

    closeScene(): void {
        this.dropScene();
        this.changed();
    }

    private dropScene(): void {
        if (this.model !== null) {
            this.model.root.removeFromParent();
            this.model.lightmaps.dispose();
            disposeScene(this.model.root);
        }
        this.model = null;
        this.sceneFile = null;
        this.litBy = '';
    }

    /** The box of what is shown. */
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
        this.balls?.setLight(this.volume.probes.irradiance);
        this.field.relight();
        this.dim();
        this.stage.draw();
        for (const listener of this.lightListeners) listener();
    }

    show(part: Part, isShown: boolean): void {
        if (isShown) this.hidden.delete(part);
        else this.hidden.add(part);
        this.applyParts();
        if (part !== 'reflections') return;
        this.applyMirror();
        for (const listener of this.mirrorListeners) listener();
    }

    /** While groups are edited, their probes and cells are shown in place of the volume's. */
    set isEditing(isEditing: boolean) {
        this.isHandedOver = isEditing;
        this.applyParts();
    }

    setColor(color: ProbeColor): void {
        this.color = color;
        this.tint();
    }

    /** Marks a probe, and looks at it. */
    selectProbe(probe: number, isLooked = true): void {
        this.selectedProbe = probe;
        this.tint();
        this.applyParts();
        for (const listener of this.selectionListeners) listener();
        if (this.volume === null || probe < 0 || !isLooked) return;
        const at = new three.Vector3().fromArray(this.volume.positions, 3 * probe);
        const {camera, controls} = this.stage;
        const away = camera.position.clone().sub(controls.target);
        away.setLength(Math.min(away.length(), 30 * this.balls!.radius));
        this.stage.look(at.clone().add(away).toArray(), at.toArray());
    }

    private showVolume(volume: OpenVolume): void {
        const hadNothing = this.volume === null && this.model === null;
        this.balls?.dispose();
        this.volume = volume;
        this.selectedProbe = -1;
        this.balls = new ProbeBalls(volume.positions, ballRadius(volume.positions, volume.probes.data.cells));
        this.stage.scene.add(this.balls.mesh);
        this.hasEdges = false;
        this.lines.clear();
        if (volume.probes.probeCount > kManyEdges) this.hidden.add('cells');
        this.applyParts();
        this.tint();
        if (hadNothing) this.stage.lookAtAll(this.box);
        this.lightScene();
        this.changed();
        this.showLight();
    }

    private placeField(): void {
        if (this.volume === null || this.volume.probes.probeCount === 0) return;
        this.field.place(this.volume.probes, gridOf(this.model?.box ?? this.box));
        this.stage.draw();
    }

    private applyParts(): void {
        const hasScene = this.model !== null && !this.hidden.has('scene');
        if (this.model !== null) this.model.root.visible = hasScene;
        this.model?.lightmaps.use(!this.hidden.has('lightmaps'));
        this.lights.visible = hasScene;  // without it there is no shadow
        if (this.balls !== null) this.balls.mesh.visible = !this.isHandedOver && !this.hidden.has('probes');
        const hasLines = !this.isHandedOver && !this.hidden.has('cells');
        if (hasLines && !this.hasEdges && this.volume !== null) {
            const {positions, probes: {data: {cells, info}}} = this.volume;
            this.lines.show(positions, edgesOf(cells, info.innerCellCount));
            this.hasEdges = true;
        }
        this.lines.group.visible = hasLines;
        this.placeMarker();
        this.stage.draw();
    }

    private placeMarker(): void {
        this.marker.visible = !this.isHandedOver && this.volume !== null && this.selectedProbe >= 0;
        if (!this.marker.visible) return;
        this.marker.position.fromArray(this.volume!.positions, 3 * this.selectedProbe);
        this.marker.scale.setScalar(this.balls!.radius);
    }

    private tint(): void {
        const {volume, selectedProbe} = this;
        if (volume === null) return;
        const {validity} = volume.probes.data;
        this.balls?.setTint(probe => {
            if (probe === selectedProbe) return [1, 0.75, 0, 0.85];
            if (this.color === 'validity' && validity.length > 0) {
                return [...badnessColor(1 - validity[probe]), 1];
            }
            if (this.color === 'error' && volume.health.length > 0) {
                return [...badnessColor(errorBadness(volume.health[probe].error)), 1];
            }
            return [0, 0, 0, 0];
        });
        this.stage.draw();
    }

    /** A volume that was baked knows its lights; else those of the scene shine. */
    private lightScene(): void {
        const probes = this.volume?.probes;
        const lights = probes && isBaked(probes) ? directLights(probes) : null;
        dropLights(this.lights);
        this.lights = makeLights(lights ?? [], this.box);
        this.lights.visible = this.model?.root.visible ?? false;
        this.stage.scene.add(this.lights);
        for (const light of this.model?.lights ?? []) light.visible = lights === null;
        this.dim();
    }

    /** Lights, surfaces and sky shine as much as the layers do that their light is in. */
    private dim(): void {
        dimLights(this.lights, this.volume?.probes.layers ?? []);
        for (const material of this.model?.emitters ?? []) {
            material.userData.strength ??= material.emissiveIntensity;
            material.emissiveIntensity = material.userData.strength *
                this.weightOf(`material:${material.name}`, 'emission', 'rest');
        }
        this.setSky();
    }

    /** The weight of the first of these layers that there is. */
    private weightOf(...names: string[]): number {
        const layers = this.volume?.probes.layers ?? [];
        return names.map(name => layers.find(layer => layer.name === name)).find(layer => layer)?.weight ?? 1;
    }

    /** The volume's, or that of the order of its bake, or the scene's. */
    private setSky(): void {
        const sky = (this.volume && skyOf(this.volume.probes)) ?? this.bake?.request?.sky ?? this.model?.sky;
        const radiance = typeof sky === 'number' ? [sky, sky, sky] : Array.isArray(sky) ? sky as number[] : null;
        if (radiance === null) this.stage.sky.radiance.set(0x11151c);
        else this.stage.sky.radiance.fromArray(radiance).multiplyScalar(this.weightOf('sky', 'rest'));
    }

    private changed(): void {
        for (const listener of this.listeners) listener();
        this.applyParts();
    }
}

/** A fourteenth of the usual distance between neighbors. */
export function ballRadius(positions: Float32Array, cells: Uint32Array): number {
    const lengths: number[] = [];
    const step = Math.max(8, Math.floor(cells.length / 8 / 500) * 8);
    for (let at = 0; at + 8 <= cells.length; at += step) {
        const [a, b] = [cells[at] * 3, cells[at + 1] * 3];
        if (a + 2 >= positions.length || b + 2 >= positions.length) continue;
        lengths.push(Math.hypot(positions[a] - positions[b], positions[a + 1] - positions[b + 1],
                                positions[a + 2] - positions[b + 2]));
    }
    lengths.sort((x, y) => x - y);
    return lengths.length === 0 ? 0.1 : 0.07 * lengths[Math.floor(lengths.length / 2)];
}
