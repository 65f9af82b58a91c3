// SPDX-License-Identifier: Apache-2.0
// What shines on its own: lights, emission and sky, as bright as the weights of the layers that their light is in.
import type {Layer} from 'tetralight';
import * as three from 'three';

import type {OtherLight} from '../light/other_light';
import {isBaked, skyOf} from '../light/volume';
import {dimLights, directLights, dropLights, makeLights} from '../light/volume_lights';
import type {Shown} from './shown';

const kUnknownSky = 0x11151c;

export class SceneLights {
    private lights = new three.Group();  // of the volume

    /** `sky`: the radiance of the sky that is drawn. */
    constructor(private readonly shown: Shown, private readonly world: three.Scene, private readonly sky: three.Color) {}

    /** A volume that was baked knows its lights; else those of the scene shine. */
    choose(): void {
        const {volume, model, box} = this.shown;
        const lights = volume !== null && isBaked(volume.probes) ? directLights(volume.probes) : null;
        dropLights(this.lights);
        this.lights = makeLights(lights ?? [], box);
        this.followScene();
        this.world.add(this.lights);
        for (const light of model?.lights ?? []) light.visible = lights === null;
        this.dim();
    }

    /** Turns the lights of the volume off while the scene, which casts their shadows, is hidden. */
    followScene(): void {
        this.lights.visible = this.shown.model?.root.visible ?? false;
    }

    /** Follows the weights of the volume. */
    dim(): void {
        dimLights(this.lights, this.shown.volume?.probes.layers ?? []);
        this.dimSceneByVolume();
    }

    /** Draws once with the lights of another volume, if it has its own. */
    drawBy({lights, layers, sky}: OtherLight, draw: () => void): void {
        if (lights === null) return draw();
        const {model} = this.shown;
        const hidden = [this.lights, ...model?.lights ?? []].filter(({visible}) => visible);
        for (const object of hidden) object.visible = false;
        lights.visible = model?.root.visible ?? false;
        this.world.add(lights);
        this.dimScene(layers ?? [], sky);
        draw();
        lights.removeFromParent();
        this.dimSceneByVolume();
        for (const object of hidden) object.visible = true;
    }

    private dimSceneByVolume(): void {
        const {volume} = this.shown;
        this.dimScene(volume?.probes.layers ?? [], volume && skyOf(volume.probes));
    }

    /** Surfaces and sky, by the layers of a volume. `sky`: null if it does not know its own. */
    private dimScene(layers: readonly Layer[], sky: readonly number[] | null): void {
        for (const material of this.shown.model?.emitters ?? []) {
            material.userData.strength ??= material.emissiveIntensity;
            material.emissiveIntensity = material.userData.strength *
                weightOf(layers, `material:${material.name}`, 'emission', 'rest');
        }
        this.setSky(layers, sky);
    }

    /** The volume's, or that of the order of its bake, or the scene's. */
    private setSky(layers: readonly Layer[], known: readonly number[] | null): void {
        const sky = known ?? this.shown.bake?.request?.sky ?? this.shown.model?.sky;
        const radiance = typeof sky === 'number' ? [sky, sky, sky] : Array.isArray(sky) ? sky as number[] : null;
        if (radiance === null) this.sky.set(kUnknownSky);
        else this.sky.fromArray(radiance).multiplyScalar(weightOf(layers, 'sky', 'rest'));
    }
}

/** The weight of the first of these layers that there is. */
function weightOf(layers: readonly Layer[], ...names: string[]): number {
    return names.map(name => layers.find(layer => layer.name === name)).find(layer => layer)?.weight ?? 1;
}
