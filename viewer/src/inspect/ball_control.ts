// SPDX-License-Identifier: Apache-2.0
// Where the ball of the tab Inspect lies: by its field, by a link, or where the camera sees a free place.
import * as three from 'three';

import {setVector, vectorInput} from '../page/dom';
import {SceneRays} from '../scene/scene_rays';
import type {Viewer} from '../view/viewer';
import {placeBall} from './ball_place';
import type {QueryObject} from './query_object';

export class BallControl {
    readonly field: HTMLElement;
    /** Milliseconds that the queries of the ball took, for `bench viewer`. */
    readonly times: number[] = [];
    private sceneId: string | null = null;
    private hasPlace = false;

    /** `moved` is called when the ball is elsewhere. */
    constructor(private readonly viewer: Viewer, private readonly object: QueryObject, private readonly moved: () => void) {
        this.field = vectorInput('Position of the ball, metres', [0, 0, 0], {step: 0.25},
                                 ([x, y, z]) => this.moveTo(new three.Vector3(x, y, z)));
    }

    get position(): number[] {
        return this.object.ball.position.toArray();
    }

    moveTo(position: three.Vector3): void {
        this.hasPlace = true;
        this.object.ball.position.copy(position);
        setVector(this.field, position.toArray());
        this.moved();
        this.viewer.stage.draw();
    }

    /** Puts the ball where the camera sees a free place for it; else it stays. */
    place(): void {
        const {model, volume, stage} = this.viewer;
        this.hasPlace = true;
        if (model === null || volume === null) return;
        const {probes} = volume;
        const rays = new SceneRays(model.root);
        const isInside = (place: three.Vector3) => probes.locate(place.toArray()).cell < probes.data.info.innerCellCount;
        const found = placeBall(stage.camera, rays, this.usualRadius, isInside) ??
            placeBall(stage.camera, rays, this.usualRadius, () => true);
        if (found === null) return;
        this.object.ball.scale.setScalar(found.radius);
        this.moveTo(found.place);
    }

    /** Puts the ball on a surface, or its middle at a point. */
    putOn(point: three.Vector3, normal: three.Vector3 | null): void {
        const radius = this.object.ball.scale.x;
        this.moveTo(normal === null ? point : point.clone().addScaledVector(normal, 1.02 * radius));
    }

    /** A new volume or scene: the ball stays where it is, in the middle at first, or gets a place in the new scene. */
    settle(): void {
        const {volume, box, sceneFile} = this.viewer;
        const {ball} = this.object;
        if (volume === null) return;
        const isNew = sceneFile?.id !== this.sceneId;
        this.sceneId = sceneFile?.id ?? null;
        ball.scale.setScalar(this.usualRadius);
        if (!this.hasPlace && ball.position.lengthSq() === 0) {
            const middle = box.getCenter(new three.Vector3());
            ball.position.set(middle.x, box.min.y + Math.min(1.5, middle.y - box.min.y), middle.z);
        }
        if (this.hasPlace && isNew) this.place();
        setVector(this.field, this.position);
    }

    /** Finds its light. */
    query(): void {
        const start = performance.now();
        const isLit = this.object.query() !== null;
        if (isLit) this.times.push(performance.now() - start);
    }

    private get usualRadius(): number {
        return 3 * (this.viewer.marks.balls?.radius ?? 0.1);
    }
}
