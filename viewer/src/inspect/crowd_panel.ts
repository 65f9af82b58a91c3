// SPDX-License-Identifier: Apache-2.0
// What else the volume lights: a crowd of 1023 about the ball, and a proxy volume to place.
import type * as three from 'three';

import type {Answers} from '../light/answers';
import {isBaked} from '../light/volume';
import {button, checkbox, element, labelled, select, setVector, slider, vectorInput} from '../page/dom';
import type {Viewer} from '../view/viewer';
import {kLeastSize, LppvBox} from './lppv_box';
import {MeshBall} from './mesh_ball';

export class CrowdPanel {
    readonly element: HTMLElement;
    readonly ball = new MeshBall();
    readonly box = new LppvBox();
    private readonly boxInputs: HTMLElement[];
    private isBallOn = false;
    private isBoxPlaced = false;
    private radius = 2;

    /** `center` is where the ball is that is dragged. */
    constructor(private readonly viewer: Viewer, private readonly center: three.Vector3) {
        this.boxInputs = [
            vectorInput('Center of the box, metres', [0, 0, 0], {step: 0.25},
                        p => this.moveBox(() => this.box.group.position.fromArray(p))),
            vectorInput('Size of the box, metres', [6, 1, 1], {step: kLeastSize, min: kLeastSize},
                        s => this.moveBox(() => this.box.group.scale.fromArray(s))),
        ];
        this.element = element(
            'div', {}, element('h2', {}, 'Mesh ball'),
            this.needy(checkbox('1023 instances, one query a frame', false, isOn => this.turnOn(isOn))),
            slider('Radius, metres', {min: 0.5, max: 10, step: 0.5, value: this.radius},
                   radius => { this.radius = radius; }),
            element('h2', {}, 'Proxy volume'),
            this.needy(checkbox('Proxy volume for a large object', false, isOn => this.showBox(isOn))),
            labelled('Handles', select([['translate', 'Move'], ['scale', 'Size']], 'translate',
                                       mode => this.holdBox(mode as 'translate' | 'scale'))),
            ...this.boxInputs,
            element('div', {class: 'buttons'}, button('To the ball', () => this.moveBox(
                () => this.box.group.position.copy(this.center)))));
        viewer.probeLight.things.push(this);
        viewer.onLight(() => this.box.relight());
        viewer.reflections.onChange(() => this.ball.mirrorBy(viewer.reflections.mirror));
    }

    /** Shows another light, or that of the volume. */
    showLight(answers: Answers | null): void {
        if (this.box.group.parent !== null) this.box.showLight(answers);
        const shown = answers ?? this.viewer.volume?.probes;
        if (this.isBallOn && shown !== undefined) this.ball.light(shown);
    }

    /** There is another volume or scene. */
    settle(): void {
        this.box.clear();
        if (!this.isBoxPlaced && this.viewer.volume !== null) {
            this.box.group.position.copy(this.center);
            this.isBoxPlaced = true;
        }
        if (this.viewer.volume !== null && this.box.group.parent !== null) this.moveBox(() => {});
    }

    /** What can do nothing without a volume. */
    private needy(control: HTMLElement): HTMLElement {
        const input = control.querySelector('input')!;
        const follow = () => { input.disabled = this.viewer.volume === null && !input.checked; };
        this.viewer.onChange(follow);
        follow();
        return control;
    }

    private turnOn(isOn: boolean): void {
        this.isBallOn = isOn;
        if (isOn) {
            this.viewer.stage.scene.add(this.ball.mesh);
            requestAnimationFrame(time => this.frame(time));
        } else {
            this.ball.mesh.removeFromParent();
            this.viewer.stage.draw();
        }
    }

    /** One query a frame. */
    private frame(time: number): void {
        if (!this.isBallOn) return;
        requestAnimationFrame(next => this.frame(next));
        const {volume} = this.viewer;
        if (volume === null || document.hidden) return;
        this.ball.turn(this.center, this.radius, time / 1000);
        this.ball.light(volume.probes);
        this.viewer.stage.draw();
    }

    private showBox(isOn: boolean): void {
        if (!isOn) {
            this.box.group.removeFromParent();
            this.viewer.gizmo.detach();
            return;
        }
        this.viewer.stage.scene.add(this.box.group);
        this.holdBox('translate');
        this.moveBox(() => {});
    }

    private holdBox(mode: 'translate' | 'scale'): void {
        if (this.box.group.parent !== null) {
            this.viewer.gizmo.attach(this.box.group, mode, () => this.moveBox(() => {}));
        }
    }

    moveBox(move: () => void): void {
        move();
        const {position, scale} = this.box.group;
        scale.clampScalar(kLeastSize, Infinity);  // handles go below 0
        setVector(this.boxInputs[0], position.toArray());
        setVector(this.boxInputs[1], scale.toArray());
        const {volume, stage} = this.viewer;
        if (this.box.group.parent !== null && volume !== null && isBaked(volume.probes)) this.box.place(volume.probes);
        stage.draw();
    }
}
