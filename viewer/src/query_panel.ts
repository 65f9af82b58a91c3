// SPDX-License-Identifier: Apache-2.0
// Query by hand: a ball to drag, a crowd of 1023, a proxy volume to place.
import {irradiance, Light, Volume} from 'tetralight';
import * as three from 'three';

import {button, checkbox, element, select, setVector, slider, vectorInput, labelled} from './dom';
import {kLeastSize, LppvBox} from './lppv_box';
import {MeshBall} from './mesh_ball';
import type {PointerUse} from './pointer';
import {QueryObject} from './query_object';
import type {Viewer} from './viewer';
import {isBaked} from './volume';

export class QueryPanel {
    readonly element: HTMLElement;
    readonly object = new QueryObject();
    readonly pointer: PointerUse;
    /** Milliseconds that the queries of the ball took, for `bench viewer`. */
    readonly times: number[] = [];
    private readonly ball = new MeshBall();
    private readonly box = new LppvBox();
    private readonly place: HTMLElement;
    private readonly answer = element('div', {class: 'answer', 'aria-live': 'polite'});
    private readonly boxInputs: HTMLElement[];
    private readonly plane = new three.Plane();
    private readonly grip = new three.Vector3();
    private isBallOn = false;
    private radius = 2;

    constructor(private readonly viewer: Viewer) {
        const {stage} = viewer;
        stage.scene.add(this.object.group);
        this.object.group.visible = false;

        this.place = vectorInput('Position of the ball, metres', [0, 0, 0], {step: 0.25},
                                 ([x, y, z]) => this.moveTo(new three.Vector3(x, y, z)));
        this.boxInputs = [
            vectorInput('Center of the box, metres', [0, 0, 0], {step: 0.25},
                        p => this.moveBox(() => this.box.group.position.fromArray(p))),
            vectorInput('Size of the box, metres', [6, 1, 1], {step: kLeastSize, min: kLeastSize},
                        s => this.moveBox(() => this.box.group.scale.fromArray(s))),
        ];
        this.element = element(
            'section', {'aria-label': 'Query'},
            element('p', {class: 'hint'}, 'Drag the ball in the scene, or type its position. The yellow ' +
                    'cell is where it lies.'),
            this.place, this.answer,
            element('h2', {}, 'Mesh ball'),
            this.needy(checkbox('1023 instances, one query a frame', false, isOn => this.turnOn(isOn))),
            slider('Radius, metres', {min: 0.5, max: 10, step: 0.5, value: this.radius},
                   radius => { this.radius = radius; }),
            element('h2', {}, 'Proxy volume'),
            this.needy(checkbox('Proxy volume for a large object', false, isOn => this.showBox(isOn))),
            labelled('Handles', select([['translate', 'Move'], ['scale', 'Size']], 'translate',
                                       mode => this.holdBox(mode as 'translate' | 'scale'))),
            ...this.boxInputs,
            element('div', {class: 'buttons'}, button('To the ball', () => this.moveBox(
                () => this.box.group.position.copy(this.object.ball.position)))));
        this.pointer = this.makePointer();
        viewer.onChange(() => this.settle());
        viewer.onLight(() => this.follow());
        viewer.onReflections(() => this.ball.mirrorBy(viewer.shownMirror));
    }

    /** What can do nothing without a volume. */
    private needy(control: HTMLElement): HTMLElement {
        const input = control.querySelector('input')!;
        const follow = () => { input.disabled = this.viewer.volume === null && !input.checked; };
        this.viewer.onChange(follow);
        follow();
        return control;
    }

    get position(): number[] {
        return this.object.ball.position.toArray();
    }

    moveTo(position: three.Vector3): void {
        this.object.ball.position.copy(position);
        setVector(this.place, position.toArray());
        this.query();
        this.viewer.stage.draw();
    }

    /** Shows the light that the ball has where it is now. */
    private query(): void {
        const start = performance.now();
        const light = this.object.query();
        if (light === null) return;
        this.times.push(performance.now() - start);
        this.announce(light, this.viewer.volume!.probes);
    }

    /** The light of the volume is another. */
    private follow(): void {
        this.query();
        this.box.relight();
    }

    /** A new volume or scene: the ball stays where it is, in the middle at first. */
    private settle(): void {
        const {volume, box, balls} = this.viewer;
        this.box.clear();
        this.object.lightBy(volume?.probes ?? null);
        const wasVisible = this.object.group.visible;
        this.object.group.visible = volume !== null;
        if (volume === null) return;
        this.object.ball.scale.setScalar(Math.max(0.2, 3 * (balls?.radius ?? 0.1)));
        if (!wasVisible && this.object.ball.position.lengthSq() === 0) {
            const middle = box.getCenter(new three.Vector3());
            this.object.ball.position.set(middle.x, box.min.y + Math.min(1.5, middle.y - box.min.y), middle.z);
            this.box.group.position.copy(this.object.ball.position);
        }
        this.moveTo(this.object.ball.position.clone());
        if (this.box.group.parent !== null) this.moveBox(() => {});
    }

    private announce({cell, probes, weights, sh}: Light, {data: {info}}: Volume): void {
        const kind = probes.length === 0 ? 'No cell: ambient light' :
            `${cell < info.innerCellCount ? 'Cell' : 'Hull cell'} ${cell}`;
        const rows = probes.map((probe, i) => element(
            'tr', {}, element('td', {}, button(`probe ${probe}`, () => this.viewer.selectProbe(probe), {class: 'link'})),
            element('td', {class: 'number'}, weights[i].toFixed(3)),
            element('td', {}, meter(weights[i]))));
        const text = (normal: number[]) => irradiance(sh, normal).map(x => (x / Math.PI).toFixed(3)).join(', ');
        this.answer.replaceChildren(
            element('h2', {}, kind),
            element('table', {}, element('caption', {}, 'Its probes'),
                    element('thead', {}, element('tr', {}, ...['Probe', 'Weight', 'Fraction'].map(
                        name => element('th', {scope: 'col'}, name)))),
                    element('tbody', {}, ...rows)),
            element('p', {class: 'facts'}, `Light from above (E/π): ${text([0, 1, 0])}`, element('br'),
                    `from below: ${text([0, -1, 0])}`));
    }

    /** The ball is dragged in a plane that faces the camera. */
    private makePointer(): PointerUse {
        const {stage} = this.viewer;
        const hit = (x: number, y: number) =>
            stage.rayAt(x, y).ray.intersectPlane(this.plane, new three.Vector3());
        return {
            press: (x, y) => {
                if (!this.object.group.visible || this.viewer.gizmo.isHot) return false;
                if (stage.rayAt(x, y).intersectObject(this.object.ball).length === 0) return false;
                const at = this.object.ball.position;
                this.plane.setFromNormalAndCoplanarPoint(stage.camera.getWorldDirection(new three.Vector3()), at);
                this.grip.copy(at).sub(hit(x, y) ?? at);
                return true;
            },
            drag: (x, y) => {
                const place = hit(x, y);
                if (place !== null) this.moveTo(place.add(this.grip));
            },
            click: (x, y) => {
                const {balls, hidden} = this.viewer;
                if (balls === null || hidden.has('probes')) return;
                this.viewer.selectProbe(balls.pick(stage.rayAt(x, y).ray), false);
            },
        };
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
        this.ball.turn(this.object.ball.position, this.radius, time / 1000);
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

    private moveBox(move: () => void): void {
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

function meter(share: number): HTMLElement {
    const made = element('meter', {min: 0, max: 1, 'aria-label': 'Weight'});
    made.value = Math.max(0, Math.min(1, share));
    return made;
}
