// SPDX-License-Identifier: Apache-2.0
// Another light for the scene that is shown, for one side of a comparison.
import type {Layer} from 'tetralight';
import * as three from 'three';

import type {Answers} from './answers';
import {Grid, LightField} from './light_field';
import {skyOf} from './volume';
import type {OpenVolume} from './volume';
import {dimLights, directLights, dropLights, makeLights} from './volume_lights';

/** What the light of probes shows on besides the scene. */
export interface LitThing {
    /** null: the light of the open volume. */
    showLight(answers: Answers | null): void;
}

export class OtherLight {
    readonly field = new LightField();

    private constructor(readonly answers: Answers,
                        /** Of another volume; null: lights, sky and emission are those of the open volume. */
                        readonly lights: three.Group | null, readonly layers: readonly Layer[] | null,
                        readonly sky: readonly number[] | null) {}

    /** Another light of probes; all else is as in the open volume. */
    static ofProbes(answers: Answers): OtherLight {
        return new OtherLight(answers, null, null, null);
    }

    /** All light of another volume. */
    static ofVolume({probes}: OpenVolume, box: three.Box3): OtherLight {
        const lights = makeLights(directLights(probes), box);
        dimLights(lights, probes.layers);
        return new OtherLight(probes, lights, probes.layers, skyOf(probes));
    }

    /** Its lights have not been drawn yet. */
    get hasNoShadows(): boolean {
        const lights = (this.lights?.children ?? []) as three.DirectionalLight[];
        return lights.some(({castShadow, shadow}) => castShadow && shadow.map === null);
    }

    place(grid: Grid): void {
        this.field.place(this.answers, grid);
    }

    dispose(): void {
        this.field.clear();
        if (this.lights !== null) dropLights(this.lights);
    }
}
