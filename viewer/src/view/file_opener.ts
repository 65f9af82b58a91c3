// SPDX-License-Identifier: Apache-2.0
// Opens what the service stores: reads it, and hands it to the viewer.
import {LayerWeights, Lightmaps, readLightmaps, readReflections} from 'tetralight';

import {Mirror} from '../light/mirror';
import {openVolume, OpenVolume, previewOf} from '../light/volume';
import {ApiError, Bake, isOfScene, namesOf, StoredFile, titleOf} from '../page/api';
import {explainScene} from '../page/gone';
import type {Viewer} from './viewer';

export class FileOpener {
    private readonly comingScenes = new Map<string, Promise<ArrayBuffer>>();

    constructor(private readonly viewer: Viewer) {}

    /** A volume, with the scene of its bake when that is known. */
    async volume(reference: string, weights: LayerWeights = {}): Promise<void> {
        const {api, alerts} = this.viewer;
        const path = `/v1/volumes/${encodeURIComponent(reference)}`;
        const bytes = api.bytes(`${path}/file`);
        bytes.catch(() => {});  // the description says what is wrong
        const [file, {bakes}] = await Promise.all([api.get<StoredFile>(path), api.get<{bakes: Bake[]}>('/v1/bakes')]);
        if (file.state === 'quarantined') {
            throw new ApiError(422, 'damaged', `the volume ${file.name || file.id} is damaged: ${file.damage}`);
        }
        const bake = bakes.find(each => each.volume === file.id) ?? null;
        const scene = bake?.request?.scene as string | undefined;
        alerts.succeed('scene');
        const [volume] = await Promise.all([
            bytes.then(received => openVolume(received, file)),
            scene === undefined ? null : alerts.attempt('scene', () => this.sceneOf(titleOf(file), scene))]);
        setKnownWeights(volume, weights);
        this.viewer.showVolume(volume, bake);
    }

    private sceneOf(volume: string, scene: string): Promise<void> {
        return this.scene(scene).catch(error => { throw explainScene(error, volume); });
    }

    async scene(reference: string): Promise<void> {
        const {viewer} = this;
        const bytes = viewer.sceneFile?.id === reference ? null : this.fetchScene(reference);
        const file = await viewer.api.get<StoredFile>(`/v1/scenes/${encodeURIComponent(reference)}`);
        if (viewer.sceneFile?.id !== file.id) await viewer.showScene(file, await (bytes ?? this.fetchScene(file.id)));
        viewer.changed();
    }

    /**
     * A scene that someone chose, in the light of the newest volume of its bakes. A volume of another scene is closed;
     * one of which no bake is known stays.
     */
    async sceneInItsLight(reference: string): Promise<void> {
        const {viewer, viewer: {api}} = this;
        await this.scene(reference);
        const [scene, volume] = [viewer.sceneFile!, viewer.volume];
        if (volume !== null && (viewer.bake === null || isOfScene(viewer.bake, scene))) return;
        if (volume !== null) viewer.closeVolume();
        const [volumes, {bakes}] = await Promise.all([api.list('volumes'), api.get<{bakes: Bake[]}>('/v1/bakes')]);
        const newest = volumes.find(({id, state}) => state === 'ready' && bakes.some(
            bake => bake.volume === id && isOfScene(bake, scene)));
        if (newest !== undefined) await this.volume(newest.id);
        else if (volume !== null) viewer.say(`${namesOf(volume.file)} is closed: it is of another scene.`);
    }

    /** Begins to fetch a scene that will be opened, before what else it takes is known. */
    fetchScene(reference: string): Promise<ArrayBuffer> {
        const known = this.comingScenes.get(reference);
        if (known !== undefined) return known;
        const bytes = this.viewer.api.bytes(`/v1/scenes/${encodeURIComponent(reference)}/file`);
        this.comingScenes.set(reference, bytes);
        const forget = () => this.comingScenes.delete(reference);
        bytes.then(forget, forget);
        return bytes;
    }

    /** Lightmaps on their scene; `bake` made them. */
    async lightmaps(id: string, scene: string, bake = id): Promise<void> {
        const {api} = this.viewer;
        const lightmaps = readLightmaps(await api.bytes(`/v1/lightmaps/${id}/file`));
        await this.showLightmaps(bake, scene, lightmaps, () => api.make(`/v1/lightmaps/${id}/export`, {scene}));
    }

    /** `unwrapped` fetches the scene with the UVs of these lightmaps. */
    private async showLightmaps(origin: string, scene: string, lightmaps: Lightmaps,
                                unwrapped: () => Promise<ArrayBuffer>): Promise<void> {
        const {viewer} = this;
        if (viewer.unwrappedFor !== origin) {
            const [file, bytes] = await Promise.all(
                [viewer.api.get<StoredFile>(`/v1/scenes/${encodeURIComponent(scene)}`), unwrapped()]);
            await viewer.showScene(file, bytes, origin);
        }
        viewer.showLightmaps(lightmaps);
    }

    /** Reflection probes; '' shows none. */
    async reflections(reference: string): Promise<void> {
        const {api, reflections} = this.viewer;
        const path = `/v1/reflections/${encodeURIComponent(reference)}`;
        const file = reference === '' ? null : await api.get<StoredFile>(path);
        reflections.open(file, file === null ? null : new Mirror(readReflections(await api.bytes(`${path}/file`))));
    }

    /** Reads the newest preview of a bake; the result shows it on its scene. */
    async preview(bake: Bake): Promise<() => void | Promise<void>> {
        const {viewer, viewer: {api}} = this;
        const path = `/v1/bakes/${bake.id}/preview`;
        const scene = String(bake.request?.scene);
        const bytes = await api.bytes(`${path}/file`);
        if (bake.kind === 'lightmaps') {
            const lightmaps = readLightmaps(bytes);
            return () => this.showLightmaps(bake.id, scene, lightmaps, () => api.bytes(`${path}/scene`));
        }
        const volume = previewOf(bake, bytes);
        await this.scene(scene);
        return () => {
            setKnownWeights(volume, viewer.changedWeights);
            viewer.showVolume(volume, bake);
        };
    }
}

/** Sets the weights of the layers that the volume has. */
function setKnownWeights({probes}: OpenVolume, weights: LayerWeights): void {
    const known = Object.entries(weights).filter(([name]) => probes.layers.some(layer => layer.name === name));
    if (known.length > 0) probes.setWeights(Object.fromEntries(known));
}
