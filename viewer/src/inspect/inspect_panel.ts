// SPDX-License-Identifier: Apache-2.0
// What is selected, a ball, an object or a probe, and the light that it has.
import * as three from 'three';

import {button, element, setVector, vectorInput} from '../page/dom';
import {boxOf, moveCenter, putBack, SceneObject} from '../scene/scene_objects';
import type {Viewer} from '../view/viewer';
import {BallControl} from './ball_control';
import {CrowdPanel} from './crowd_panel';
import {InspectPointer, Selector} from './inspect_pointer';
import {keyMove} from './key_moves';
import {LightCard} from './light_card';
import {objectFacts} from './object_facts';
import {ObjectList} from './object_list';
import {pick, Picked} from './pick';
import {QueryObject} from './query_object';
import {hintOf, objectOf, Selected, titleOfSelected} from './selected';
import {SelectionMarks} from './selection_marks';

export class InspectPanel implements Selector {
    readonly element: HTMLElement;
    readonly object = new QueryObject();
    readonly pointer = new InspectPointer(this);
    readonly ball: BallControl;
    readonly crowd: CrowdPanel;
    private readonly title = element('h2', {}, 'Ball');
    private readonly hint = element('p', {class: 'hint'});
    private objectPlace: HTMLElement = element('div');
    private readonly card: LightCard;
    private readonly facts = element('div');
    private readonly list: ObjectList;
    private readonly putHere = button('Put the ball here', () => this.putBallHere());
    private readonly back = button('Put it back', () => this.putItBack());
    private readonly marks: SelectionMarks;
    private selected: Selected = {kind: 'ball'};
    private isActiveNow = true;
    private isTellingDue = false;

    constructor(readonly viewer: Viewer) {
        const {stage} = viewer;
        stage.scene.add(this.object.group);
        this.object.group.visible = false;
        this.marks = new SelectionMarks(viewer, this.object);
        this.card = new LightCard(stage, {select: probe => this.lookAtProbe(probe), point: probe => this.pointAt(probe)});
        this.list = new ObjectList(object => object === null ? this.selectBall() : this.selectObject(object));
        this.crowd = new CrowdPanel(viewer, this.object.ball.position);
        this.ball = new BallControl(viewer, this.object, () => this.query());
        this.element = element(
            'section', {'aria-label': 'Inspect'}, element('div', {'aria-live': 'polite'}, this.title, this.hint),
            element('div', {class: 'buttons'}, this.putHere, this.back),
            this.ball.field, this.objectPlace, this.card.element, this.facts,
            element('h2', {}, 'Objects'), this.list.element, this.crowd.element);
        viewer.probeLight.things.push(this.object);
        stage.canvas.addEventListener('keydown', event => this.key(event));
        stage.drawn.push(() => this.card.followView());
        viewer.onChange(() => this.settle());
        viewer.onSelect(() => this.followProbe());
        viewer.onLight(() => this.query());
        viewer.reflections.onChange(() => this.tell());
        this.settle();
    }

    /** While something else has the view, nothing of this is in it. */
    set isActive(isActive: boolean) {
        this.isActiveNow = isActive;
        this.tell();
    }

    get shownBall(): three.Object3D | null {
        return this.object.group.visible ? this.object.ball : null;
    }

    /** What F frames. */
    frame(): void {
        const {selected, viewer: {stage, marks}} = this;
        if (selected.kind === 'none') stage.frame(this.viewer.box.getBoundingSphere(new three.Sphere()), 0.9);
        else if (selected.kind === 'object') stage.frame(boxOf(selected.object).getBoundingSphere(new three.Sphere()), 0.6);
        else stage.frame(new three.Sphere(this.at!, selected.kind === 'ball' ? this.object.ball.scale.x : 2 * marks.balls!.radius), 0.3);
    }

    /** A new volume or scene. */
    private settle(): void {
        const {volume, model} = this.viewer;
        this.object.lightBy(volume?.probes ?? null);
        this.object.group.visible = volume !== null;
        this.list.show(model?.objects ?? []);
        if (this.selected.kind === 'object') {
            const {name} = this.selected.object;
            const same = model?.objects.find(object => object.name === name);
            this.selected = same === undefined ? {kind: 'ball'} : {...this.selected, object: same};
        } else if (this.selected.kind === 'probe') {
            this.selected = {kind: 'ball'};
        }
        this.ball.settle();
        this.showSelected();
        this.crowd.settle();
    }

    private select(selected: Selected): void {
        this.selected = selected;
        this.viewer.selectProbe(selected.kind === 'probe' ? selected.probe : -1, false);
        this.showSelected();
    }

    selectProbe(probe: number): void {
        this.select({kind: 'probe', probe});
    }

    selectBall(): void {
        if (this.selected.kind !== 'ball') this.select({kind: 'ball'});
    }

    selectNothing(): void {
        this.select({kind: 'none'});
    }

    /** A probe was selected elsewhere. */
    private followProbe(): void {
        const {selected, viewer: {marks: {selectedProbe: probe}}} = this;
        if (probe < 0 || selected.kind === 'probe' && selected.probe === probe) return;
        this.selected = {kind: 'probe', probe};
        this.showSelected();
    }

    private lookAtProbe(probe: number): void {
        this.select({kind: 'probe', probe});
        this.viewer.selectProbe(probe);
    }

    /** By name: the place of a static object is on its side that the camera sees. */
    selectObject(object: SceneObject, hit: Picked | null = null): void {
        const center = boxOf(object).getCenter(new three.Vector3());
        const {camera} = this.viewer.stage;
        const seen = hit ?? pick(new three.Raycaster(camera.position, center.clone().sub(camera.position).normalize()), [object]);
        const isSurface = object.isStatic && seen !== null;
        this.select({kind: 'object', object, place: isSurface ? seen.point : center, normal: isSurface ? seen.normal : null});
    }

    /** Where what is selected has its light; null: nothing is selected. */
    get at(): three.Vector3 | null {
        const {selected, viewer: {volume}} = this;
        if (selected.kind === 'ball') return this.object.ball.position;
        if (selected.kind === 'probe') return volume === null ? null : new three.Vector3(...volume.probes.position(selected.probe));
        return selected.kind === 'object' ? selected.place : null;
    }

    private showSelected(): void {
        const {selected, viewer: {volume}} = this;
        const object = objectOf(selected);
        this.title.textContent = titleOfSelected(selected);
        this.hint.textContent = hintOf(selected, volume);
        this.ball.field.hidden = selected.kind !== 'ball';
        this.putHere.hidden = object === null || !object.isStatic || volume === null;
        this.back.hidden = object === null || object.isStatic;
        const moving = object === null || object.isStatic ? element('div') :
            vectorInput(`Position of ${object.name}, metres`, this.at!.toArray(), {step: 0.25},
                        p => this.moveSelected(new three.Vector3().fromArray(p)));
        this.objectPlace.replaceWith(moving);
        this.objectPlace = moving;
        this.list.select(object, selected.kind === 'ball');
        this.query();
        this.viewer.stage.draw();
    }

    /** Moves the ball, or an object that moves. */
    moveSelected(to: three.Vector3): void {
        const {selected, viewer} = this;
        if (selected.kind === 'ball') this.ball.moveTo(to);
        if (selected.kind !== 'object' || selected.object.isStatic) return;
        moveCenter(selected.object, to);
        this.follow(selected.object);
        viewer.stage.draw();
    }

    moved(): void {
        if (this.selected.kind === 'object') this.viewer.reflections.apply();
    }

    private follow(object: SceneObject): void {
        if (this.selected.kind === 'object') boxOf(object).getCenter(this.selected.place);
        this.viewer.probeLight.placeMovers(this.viewer.model!.movers.filter(mover => mover.object === object));
        setVector(this.objectPlace, this.at!.toArray());
        this.query();
    }

    private putItBack(): void {
        if (this.selected.kind !== 'object') return;
        putBack(this.selected.object);
        this.follow(this.selected.object);
        this.moved();
    }

    private putBallHere(): void {
        if (this.selected.kind === 'object') this.putBall(this.selected.place, this.selected.normal);
    }

    putBall(point: three.Vector3, normal: three.Vector3 | null): void {
        this.select({kind: 'ball'});
        this.ball.putOn(point, normal);
    }

    /** Finds the light of the ball, and of what is selected. */
    private query(): void {
        this.ball.query();
        this.tell();
    }

    /** Many moves between two pictures are told once. */
    private tell(): void {
        if (this.isTellingDue) return;
        this.isTellingDue = true;
        requestAnimationFrame(() => {
            this.isTellingDue = false;
            this.tellNow();
        });
    }

    private tellNow(): void {
        const {selected, at, viewer: {volume}} = this;
        const object = objectOf(selected);
        const normal = selected.kind === 'object' ? selected.normal : null;
        const light = volume === null || at === null ? null :
            volume.probes.light(at.toArray(), normal === null ? {} : {normal: normal.toArray()});
        this.card.element.hidden = light === null;
        if (light !== null) this.card.show(light, at!, volume!);
        this.facts.replaceChildren(...object === null ? [] : [objectFacts(this.viewer, object, at!)]);
        this.marks.show(light, object);
    }

    pointAt(probe: number): void {
        this.marks.pointAt(probe);
    }

    private key(event: KeyboardEvent): void {
        if (!this.isActiveNow) return;
        if (event.key === 'Escape') this.selectNothing();
        const way = keyMove(event, this.viewer.stage.camera);
        if (way === null || this.at === null) return;
        event.preventDefault();
        this.moveSelected(this.at.clone().add(way));
        this.moved();
    }
}
