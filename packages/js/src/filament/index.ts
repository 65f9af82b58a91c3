// SPDX-License-Identifier: Apache-2.0
// The light of probes in Filament, where it is that of a whole scene:
//
//     const light = new SceneLight(Filament, engine, scene, read(buffer));
//     each frame: light.moveTo(position of the object);
import type {Engine, IndirectLight, IndirectLight$Builder, Scene} from 'filament';

import {MovingLight, ObjectOptions} from '../moving_light.js';
import {polynomialSh} from '../polynomial_sh.js';
import type {Vector} from '../sh.js';
import type {Volume} from '../volume.js';

/** What is used of the module `Filament`, after `Filament.init`. */
export interface FilamentModule {
    IndirectLight: {Builder(): IndirectLight$Builder};
}

/** The light of a position as `IndirectLight$Builder.irradianceSh(3, …)` takes it. */
export function irradianceSh(sh: Vector): Float32Array {
    return polynomialSh(sh);
}

/**
 * An IndirectLight with the light of a position alone, without reflections. Its intensity is 1: the light has the units of
 * the volume, and the exposure of the camera counts.
 */
export function makeIndirectLight(filament: FilamentModule, engine: Engine, sh: Vector): IndirectLight {
    return filament.IndirectLight.Builder().irradianceSh(3, irradianceSh(sh)).intensity(1).build(engine);
}

/**
 * Lights a scene as one object of it is lit. Filament has one IndirectLight per scene, so objects with different light
 * need a scene and a view each. Each move makes an IndirectLight in place of that of before.
 */
export class SceneLight {
    private readonly light = new MovingLight();
    private position: Vector = [NaN, NaN, NaN];
    private built?: IndirectLight;

    constructor(private readonly filament: FilamentModule, private readonly engine: Engine, private readonly scene: Scene,
                readonly volume: Volume, private readonly options: ObjectOptions = {}) {}

    /** To the light at a world position. */
    moveTo(position: Vector): void {
        this.position = [position[0], position[1], position[2]];
        if (!this.light.moveTo(position, this.volume, this.options)) return;
        const built = makeIndirectLight(this.filament, this.engine, this.light.sh);
        this.scene.setIndirectLight(built);
        if (this.built) this.engine.destroyIndirectLight(this.built);
        this.built = built;
    }

    /** After the light of the volume changed (`Volume.setWeights`). */
    refresh(): void {
        if (!this.built) return;
        this.light.forget();
        this.moveTo(this.position);
    }

    destroy(): void {
        this.scene.setIndirectLight(null);
        if (this.built) this.engine.destroyIndirectLight(this.built);
        this.built = undefined;
        this.light.forget();
    }
}
