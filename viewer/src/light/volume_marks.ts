// SPDX-License-Identifier: Apache-2.0
// What marks a volume in the scene: a ball at each probe, the edges of its cells, a ring around the selected probe.
import * as three from 'three';

import {badnessColor, errorBadness} from '../page/colors';
import {edgesOf} from './cell_edges';
import {CellLines} from './cell_lines';
import {ProbeBalls} from './probe_balls';
import type {OpenVolume} from './volume';

export type ProbeColor = 'light' | 'validity' | 'error';

/** Probes that are not of the selected cell are smaller: they hide less of the scene. */
const kOtherProbes = 0.5;
/** So large that its light can be judged. Of the distance. */
const kLargestProbe = 0.1;

export class VolumeMarks {
    readonly group = new three.Group();
    readonly lines = new CellLines();
    readonly ring = makeRing();
    /** Marks of the panels. */
    readonly others = new three.Group();
    balls: ProbeBalls | null = null;
    selectedProbe = -1;
    private volume: OpenVolume | null = null;
    private shownColor: ProbeColor = 'light';
    private hasEdges = false;

    constructor() {
        this.group.add(this.lines.group, this.ring, this.others);
    }

    /** Marks another volume, or none. */
    show(volume: OpenVolume | null): void {
        this.balls?.dispose();
        this.balls = null;
        this.lines.clear();
        this.hasEdges = false;
        this.selectedProbe = -1;
        this.volume = volume;
        if (volume === null) return;
        const {positions, probes: {data: {cells}}} = volume;
        this.balls = new ProbeBalls(positions, ballRadius(positions, cells), kOtherProbes, kLargestProbe);
        this.group.add(this.balls.mesh);
        this.tint();
    }

    /** Which of the marks are in the picture. */
    showParts(parts: {probes: boolean; cells: boolean; ring: boolean; others: boolean}): void {
        if (this.balls !== null) this.balls.mesh.visible = parts.probes;
        if (parts.cells) this.makeEdges();
        this.lines.group.visible = parts.cells;
        this.others.visible = parts.others;
        this.ring.visible = parts.ring && this.volume !== null && this.selectedProbe >= 0;
    }

    /** -1: none. */
    select(probe: number): void {
        this.selectedProbe = probe;
        this.tint();
        if (this.volume === null || probe < 0) return;
        this.ring.position.fromArray(this.volume.positions, 3 * probe);
        this.ring.scale.setScalar(this.balls!.radius);
    }

    get color(): ProbeColor {
        return this.shownColor;
    }

    set color(color: ProbeColor) {
        this.shownColor = color;
        this.tint();
    }

    private tint(): void {
        const {volume, shownColor, selectedProbe} = this;
        if (volume === null) return;
        const {health, probes: {data: {validity}}} = volume;
        this.balls!.setTint(probe => {
            if (probe === selectedProbe) return [1, 0.75, 0, 0.85];
            if (shownColor === 'validity' && validity.length > 0) return [...badnessColor(1 - validity[probe]), 1];
            if (shownColor === 'error' && health.length > 0) return [...badnessColor(errorBadness(health[probe].error)), 1];
            return [0, 0, 0, 0];
        });
    }

    /** Those of large volumes take a while. */
    private makeEdges(): void {
        if (this.hasEdges || this.volume === null) return;
        const {positions, probes: {data: {cells, info}}} = this.volume;
        this.lines.show(positions, edgesOf(cells, info.innerCellCount));
        this.hasEdges = true;
    }
}

/** Faces the camera, and is seen through walls. */
function makeRing(): three.Mesh {
    const ring = new three.Mesh(
        new three.TorusGeometry(1.6, 0.16, 8, 48),
        new three.MeshBasicMaterial({color: 0xffc000, depthTest: false, transparent: true, toneMapped: false}));
    ring.renderOrder = 10;
    ring.onBeforeRender = (_, __, camera) => {
        ring.quaternion.copy(camera.quaternion);
        ring.updateMatrixWorld();
        ring.modelViewMatrix.multiplyMatrices(camera.matrixWorldInverse, ring.matrixWorld);
    };
    return ring;
}

/** A fourteenth of the usual distance between neighbors. */
function ballRadius(positions: Float32Array, cells: Uint32Array): number {
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
