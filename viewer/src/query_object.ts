// SPDX-License-Identifier: Apache-2.0
// A ball that is dragged about: its cell, the probes around it, their weights, and the light they give.
import * as three from 'three';

import {packedLight} from './packed_light';
import {decodeAnswer, encodeQuery, Locations, WantedSh} from './query_binary';
import {lightBySh} from './shaders';
import {cornersOf, Light, Volume} from './volume';

export interface QueryAnswer {
    places: Locations;
    packed: Float32Array;
}

export class QueryObject {
    readonly group = new three.Group();
    readonly ball: three.Mesh;
    private readonly sh = {value: Array.from({length: 7}, () => new three.Vector4())};
    private readonly lines: three.LineSegments;

    constructor() {
        const material = new three.MeshLambertMaterial({color: 0xffffff});
        lightBySh(material, this.sh);
        this.ball = new three.Mesh(new three.SphereGeometry(1, 32, 20), material);
        this.ball.receiveShadow = true;
        this.ball.castShadow = true;
        this.lines = new three.LineSegments(new three.BufferGeometry(), new three.LineBasicMaterial(
            {color: 0xffe14a, depthTest: false, toneMapped: false}));
        this.lines.frustumCulled = false;
        this.lines.renderOrder = 10;
        this.group.add(this.ball, this.lines);
    }

    get question(): ArrayBuffer {
        return encodeQuery(new Float32Array(this.ball.position.toArray()), WantedSh.Packed);
    }

    /** Shows an answer; the light is the server's, or blended here when layers have other weights. */
    show(body: ArrayBuffer, volume: Volume, light: Light | null): QueryAnswer {
        const answer = decodeAnswer(body);
        const packed = light === null ? answer.sh.slice() : packedLight(volume, light, answer.locations);
        this.sh.value.forEach((vector, i) => vector.fromArray(packed, 4 * i));
        this.outline(volume, answer.locations.cells[0]);
        return {places: answer.locations, packed};
    }

    /** The edges of the cell, and lines to its probes. */
    private outline(volume: Volume, cell: number): void {
        const corners = cornersOf(volume.cells, cell).map(
            probe => new three.Vector3().fromArray(volume.positions, 3 * probe));
        const ends: three.Vector3[] = [];
        corners.forEach((a, i) => corners.slice(i + 1).forEach(b => ends.push(a, b)));
        this.lines.geometry.dispose();
        this.lines.geometry = new three.BufferGeometry().setFromPoints(ends);
    }
}
