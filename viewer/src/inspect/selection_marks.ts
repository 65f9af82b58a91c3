// SPDX-License-Identifier: Apache-2.0
// What marks the selection in the scene: its box, its cell, the weights of its probes.
import type {Light} from 'tetralight';
import * as three from 'three';

import {boxOf, SceneObject} from '../scene/scene_objects';
import {Label, Labels} from '../view/labels';
import type {Viewer} from '../view/viewer';
import {probeWords} from './light_card';
import type {QueryObject} from './query_object';
import {SelectionBox} from './selection_box';

export class SelectionMarks {
    private readonly labels: Labels;
    private readonly brackets = new SelectionBox();
    private pointed = -1;  // a probe

    constructor(private readonly viewer: Viewer, private readonly ball: QueryObject) {
        this.labels = new Labels(viewer.stage, () => viewer.marks.balls?.mesh.visible === true);
        viewer.marks.others.add(this.brackets.lines, ball.lines);
    }

    show(light: Light | null, object: SceneObject | null): void {
        const {volume} = this.viewer;
        const probes = light?.probes ?? [];
        this.brackets.show(object === null ? null : boxOf(object));
        this.ball.lines.visible = volume !== null;
        if (volume !== null) this.ball.outline(volume.probes, probes);
        this.viewer.marks.balls?.choose(probes);
        this.viewer.stage.draw();
        this.labels.show('weight', probes.map(
            (probe, i) => this.label(probe, `${(100 * light!.weights[i]).toFixed(0)} %`)));
    }

    /** Names a probe in the scene; -1: none. */
    pointAt(probe: number): void {
        if (probe === this.pointed) return;
        this.pointed = probe;
        const {volume} = this.viewer;
        this.labels.show('name', probe < 0 || volume === null ? [] : [this.label(probe, probeWords(volume, probe))]);
    }

    private label(probe: number, text: string): Label {
        return {text, at: new three.Vector3(...this.viewer.volume!.probes.position(probe))};
    }
}
