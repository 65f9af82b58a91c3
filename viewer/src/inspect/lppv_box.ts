// SPDX-License-Identifier: Apache-2.0
// A proxy volume to place and size: a large white block, each pixel lit from its 3D texture.
import type {Volume} from 'tetralight';
import * as three from 'three';

import type {Answers} from '../light/answers';
import {Grid, LightField} from '../light/light_field';
import {lightByLppv} from '../light/shaders';

/** Of each edge, in metres. */
export const kLeastSize = 0.05;

const kPointsPerMeter = 2;
const kMostPoints = 32;  // along an axis

export class LppvBox {
    /** Its position and scale are the box's middle and size. */
    readonly group = new three.Group();
    private readonly block: three.Mesh;
    private readonly field = new LightField();

    constructor() {
        const material = new three.MeshLambertMaterial({color: 0xffffff});
        lightByLppv(material, this.field.uniforms);
        this.block = new three.Mesh(new three.BoxGeometry(0.96, 0.96, 0.96), material);
        this.block.castShadow = true;
        this.block.receiveShadow = true;
        this.block.visible = false;
        const edges = new three.LineSegments(
            new three.EdgesGeometry(new three.BoxGeometry(1, 1, 1)),
            new three.LineBasicMaterial({color: 0x7fe3a0, toneMapped: false}));
        this.group.add(this.block, edges);
        this.group.scale.set(6, 1, 1);
    }

    /** Finds the light of a volume where the box is now. */
    place(volume: Volume): void {
        this.field.place(volume, this.grid);
        this.block.visible = true;
    }

    relight(): void {
        if (this.block.visible) this.field.relight();
    }

    /** Shows another light, or that of its volume. */
    showLight(answers: Answers | null): void {
        this.field.showLight(answers);
    }

    clear(): void {
        this.field.clear();
        this.block.visible = false;
    }

    get grid(): Grid {
        const {position, scale} = this.group;
        const resolution = scale.toArray().map(
            length => Math.min(kMostPoints, Math.max(2, Math.ceil(kPointsPerMeter * length) + 1)));
        return {low: position.clone().addScaledVector(scale, -0.5), size: scale.clone(), resolution};
    }
}
