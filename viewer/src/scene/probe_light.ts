// SPDX-License-Identifier: Apache-2.0
// The light of the open volume on what is shown: the scene, its objects that move, and what panels add.
import {Grid, gridOf, LightField} from '../light/light_field';
import type {LitThing, OtherLight} from '../light/other_light';
import type {Shown} from './shown';

export class ProbeLight {
    /** On the scene. */
    readonly field = new LightField();
    /** What takes its light from the volume besides the scene. */
    readonly things: LitThing[] = [];

    constructor(private readonly shown: Shown) {}

    /** Where the light of surfaces is found. */
    get grid(): Grid {
        return gridOf(this.shown.model?.box ?? this.shown.box);
    }

    /** Another volume or scene. */
    place(): void {
        const {volume} = this.shown;
        this.placeMovers();
        if (volume === null) this.field.clear();
        else if (volume.probes.probeCount > 0) this.field.place(volume.probes, this.grid);
    }

    /** Other weights of layers. */
    relight(): void {
        this.field.relight();
        this.placeMovers();
    }

    /** Objects that move take their light from where they are. */
    placeMovers(movers = this.shown.model?.movers ?? []): void {
        for (const mover of movers) mover.place(this.shown.volume?.probes ?? null);
    }

    /** Draws once by another light. */
    drawBy({field, answers}: OtherLight, draw: () => void): void {
        const things: LitThing[] = [...this.things, ...this.shown.model?.movers ?? []];
        this.field.showOther(field);
        for (const thing of things) thing.showLight(answers);
        draw();
        for (const thing of things) thing.showLight(null);
        this.field.showOther(null);
    }
}
