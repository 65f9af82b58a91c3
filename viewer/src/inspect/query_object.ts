// SPDX-License-Identifier: Apache-2.0
// A ball that is dragged about, lit by the probes around it, and the edges of its cell.
import {kNone, Light, Volume} from 'tetralight';
import {ProbeVolume} from 'tetralight/three';
import * as three from 'three';

import type {Answers} from '../light/answers';

export class QueryObject {
    readonly group = new three.Group();
    readonly ball: three.Mesh;
    readonly lines: three.LineSegments;
    private probes: ProbeVolume | null = null;
    private readonly plain: three.Material;
    private own: three.Material | three.Material[];  // lit by the volume
    /** Of the sides of a comparison. */
    private readonly others = new WeakMap<Answers, {probes: ProbeVolume; material: three.Material | three.Material[]}>();
    private cell = kNone;  // where it was

    constructor() {
        this.ball = new three.Mesh(new three.SphereGeometry(1, 32, 20), new three.MeshLambertMaterial({color: 0xffffff}));
        this.plain = this.own = this.ball.material as three.Material;
        this.ball.receiveShadow = true;
        this.ball.castShadow = true;
        this.lines = new three.LineSegments(new three.BufferGeometry(), new three.LineBasicMaterial(
            {color: 0xffe14a, depthTest: false, toneMapped: false}));
        this.lines.frustumCulled = false;
        this.lines.renderOrder = 10;
        this.group.add(this.ball);
    }

    /** Takes its light from the probes of a volume from now on. */
    lightBy(volume: Volume | null): void {
        if (this.probes !== null && this.probes.volume === volume) return;
        this.probes?.remove(this.ball);
        this.probes = volume === null ? null : new ProbeVolume(volume);
        this.probes?.add(this.ball);
        this.own = this.ball.material;
        this.cell = kNone;
    }

    /** Shows another light, or that of its volume. */
    showLight(answers: Answers | null): void {
        if (answers === null) {
            this.ball.material = this.own;
            return;
        }
        const {probes, material} = this.other(answers);
        this.ball.material = material;
        probes.refresh();
    }

    private other(answers: Answers): {probes: ProbeVolume; material: three.Material | three.Material[]} {
        const known = this.others.get(answers);
        if (known !== undefined) return known;
        this.ball.material = this.plain;
        const probes = new ProbeVolume(answers as Volume);
        probes.add(this.ball);
        const made = {probes, material: this.ball.material};
        this.others.set(answers, made);
        return made;
    }

    /** Shows the light where it is now; null without a volume. */
    query(): Light | null {
        if (this.probes === null) return null;
        const {volume} = this.probes;
        this.ball.updateWorldMatrix(true, false);
        this.probes.refresh();
        const light = volume.light(this.ball.position.toArray(), {hint: this.cell});
        this.cell = light.cell;
        return light;
    }

    /** Draws the edges between these probes, those of a cell. */
    outline(volume: Volume, probes: readonly number[]): void {
        const corners = probes.map(probe => new three.Vector3(...volume.position(probe)));
        const ends = corners.flatMap((a, i) => corners.slice(i + 1).flatMap(b => [a, b]));
        this.lines.geometry.dispose();
        this.lines.geometry = new three.BufferGeometry().setFromPoints(ends);
    }
}
