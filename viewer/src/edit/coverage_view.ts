// SPDX-License-Identifier: Apache-2.0
// How much of the free space the edited probes cover, in words and as marks in the view.
import type {Volume} from 'tetralight';
import * as three from 'three';

import {ProbeBalls} from '../light/probe_balls';
import {checkbox, element} from '../page/dom';
import {Newest} from '../page/newest';
import type {SceneModel} from '../scene/scene_model';
import type {Viewer} from '../view/viewer';
import type {Box} from './boxes';
import {Coverage, findCoverage, findPlaces, Places, SceneSpace, shareOf, Slices} from './coverage';
import type {EditSession} from './edit_session';
import {countOf, type Position} from './groups';
import type {GroupsEditor} from './groups_editor';
import {spaceOf} from './scene_space';

interface Question {
    model: SceneModel;
    probes: Volume | null;
    boxes: readonly Box[];
}

interface Known {
    model: SceneModel;
    space: SceneSpace | null;
    places: Promise<Places | null>;
}

type Answer = Coverage | 'too large' | null;

const kOutside = [0.9, 0.1, 0.1, 1] as const;
const kUnseen = [0.6, 0.25, 1, 1] as const;

const percent = (share: number) => `${(100 * share).toFixed(1)} %`;

export class CoverageView {
    readonly element: HTMLElement;
    private readonly meter = element('meter', {min: 0, max: 1, 'aria-label': 'Coverage'});
    private readonly share = element('output', {});
    private readonly words = element('p', {class: 'hint', 'aria-live': 'polite'});
    private readonly root = new three.Group();
    private balls: ProbeBalls | null = null;
    private known: Known | null = null;
    private isActiveNow = false;
    private boxes: readonly Box[] = [];
    private readonly newest: Newest<Question, Answer>;

    constructor(private readonly viewer: Viewer, private readonly session: EditSession, private readonly editor: GroupsEditor) {
        const mark = checkbox('Mark uncovered places', true, isOn => {
            this.root.visible = isOn;
            viewer.stage.draw();
        });
        this.element = element('section', {class: 'coverage', 'aria-label': 'Coverage of the free space'},
                               element('div', {class: 'row'}, element('span', {}, 'Coverage'), this.meter, this.share),
                               this.words, mark);
        this.newest = new Newest(question => this.find(question), answer => this.show(answer),
                                 error => viewer.alerts.report('coverage', error));
        viewer.stage.scene.add(this.root);
        editor.joined.onChange(() => this.ask());
        session.onChange(() => {
            if (session.now.boxes !== this.boxes) this.ask();
        });
        viewer.onChange(() => this.ask());
    }

    set isActive(isActive: boolean) {
        this.isActiveNow = isActive;
        if (this.balls !== null) this.balls.mesh.visible = isActive;
        this.ask();
    }

    private ask(): void {
        const {viewer: {model}, editor} = this;
        this.boxes = this.session.now.boxes;
        const isJoining = editor.joined.tetrahedra === null && countOf(editor.now) > 0;
        if (!this.isActiveNow || isJoining) return;
        if (model === null) {
            this.newest.forget();
            this.showMarks([], []);
            this.showWords(null, 'Open a scene to see which places no probe covers.');
            return;
        }
        if (this.share.textContent === '') this.showWords(null, 'Looking at the free space…');
        this.newest.ask({model, probes: editor.joined.volume, boxes: this.boxes});
    }

    private async find({model, probes, boxes}: Question): Promise<Answer> {
        if (this.known?.model !== model) {
            const space = spaceOf(model);
            const slices = new Slices(() => this.viewer.model === model);
            this.known = {model, space, places: space === null ? Promise.resolve(null) : findPlaces(space, slices)};
        }
        const {space} = this.known;
        const places = await this.known.places;
        if (space === null) return 'too large';
        if (places === null) return null;
        return findCoverage(space, places, probes, boxes, new Slices(() => !this.newest.isWaiting));
    }

    private show(answer: Answer): void {
        if (answer === null) return;
        if (answer === 'too large') {
            this.showWords(null, 'The scene has too many triangles to find the coverage here: see the report of the grid or of the bake.');
            return;
        }
        const {covered, outside, unseen} = answer;
        const count = covered + outside.length + unseen.length;
        const of = (list: readonly Position[]) => percent(list.length / Math.max(1, count));
        this.showMarks(outside, unseen);
        this.showWords(count === 0 ? null : shareOf(answer), count === 0 ? 'The scene has no free space.' :
            'of the free space sees its probes. ' + [
                outside.length === 0 ? '' : `${of(outside)} is outside of the tetrahedra (red). `,
                unseen.length === 0 ? '' : `${of(unseen)} is out of sight of probes (violet).`].join(''));
    }

    private showWords(share: number | null, words: string): void {
        this.meter.hidden = this.share.hidden = share === null;
        this.meter.value = share ?? 0;
        this.share.textContent = share === null ? '' : percent(share);
        this.words.textContent = words;
    }

    private showMarks(outside: readonly Position[], unseen: readonly Position[]): void {
        this.balls?.dispose();
        this.balls = new ProbeBalls(new Float32Array([...outside, ...unseen].flat()), 0.5 * this.editor.radius);
        this.balls.setTint(i => i < outside.length ? kOutside : kUnseen);
        this.balls.mesh.visible = this.isActiveNow;
        this.root.add(this.balls.mesh);
        this.viewer.stage.draw();
    }
}
