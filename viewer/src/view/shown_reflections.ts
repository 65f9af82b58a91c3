// SPDX-License-Identifier: Apache-2.0
// The reflection probes that surfaces mirror, and the stored files to choose from.
import * as three from 'three';

import {hideMirror, Mirror} from '../light/mirror';
import type {ReflectionBalls} from '../light/reflection_balls';
import type {StoredFile} from '../page/api';
import type {Shown} from '../scene/shown';
import type {Stage} from './stage';

export class ShownReflections {
    files: readonly StoredFile[] = [];
    /** The one that is open. */
    file: StoredFile | null = null;
    private opened: Mirror | null = null;
    private isOn = true;
    private balls: ReflectionBalls | null = null;
    private areBallsOn = false;
    private readonly listeners: (() => void)[] = [];

    constructor(private readonly shown: Shown, private readonly stage: Stage) {}

    /** Called when there are other files, or surfaces mirror others. */
    onChange(listener: () => void): void {
        this.listeners.push(listener);
    }

    setFiles(files: readonly StoredFile[]): void {
        this.files = files;
        this.changed();
    }

    /** Surfaces mirror the probes of a file, or none. */
    open(file: StoredFile | null, mirror: Mirror | null): void {
        this.opened?.dispose();
        this.opened = mirror;
        this.file = file;
        this.showBalls(this.areBallsOn);
        this.apply();
        this.changed();
    }

    turnOn(isOn: boolean): void {
        this.isOn = isOn;
        this.apply();
        this.changed();
    }

    /** What surfaces mirror now. */
    get mirror(): Mirror | null {
        return this.isOn ? this.opened : null;
    }

    /** Surfaces choose their reflection probes by where they are. */
    apply(): void {
        const {mirror} = this;
        for (const surface of this.shown.model?.surfaces ?? []) {
            if (mirror === null) hideMirror(surface.material);
            else mirror.showOn(surface);
        }
        this.stage.draw();
    }

    /** A mirror at the place of each reflection probe. */
    showBalls(areOn: boolean): void {
        this.areBallsOn = areOn;
        this.balls?.dispose();
        const radius = 0.015 * this.shown.box.getSize(new three.Vector3()).length();
        this.balls = areOn ? this.opened?.balls(radius) ?? null : null;
        if (this.balls !== null) this.stage.scene.add(this.balls.group);
        this.stage.draw();
    }

    private changed(): void {
        for (const listener of this.listeners) listener();
    }
}
