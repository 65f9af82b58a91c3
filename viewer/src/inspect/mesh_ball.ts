// SPDX-License-Identifier: Apache-2.0
// 1023 instances that turn about a place, all lit by one query a frame.
import {kNone, kPacked} from 'tetralight';
import * as three from 'three';

import type {Answers} from '../light/answers';
import {hideMirror, Mirror} from '../light/mirror';
import {lightInstances, setInstanceSh} from '../light/shaders';

const kCount = 1023;

export class MeshBall {
    readonly mesh: three.InstancedMesh;
    private readonly packed: three.InstancedInterleavedBuffer;
    private readonly directions: three.Vector3[];
    private readonly distances: number[];
    private readonly positions = new Float32Array(3 * kCount);
    private readonly cells = new Uint32Array(kCount).fill(kNone);
    private readonly box = new three.Box3();
    private mirror: Mirror | null = null;
    private chooseCubes = () => {};

    constructor() {
        const geometry = new three.IcosahedronGeometry(1, 2);
        const material = new three.MeshLambertMaterial({color: 0xffffff});
        this.packed = setInstanceSh(geometry, new Float32Array(kCount * kPacked));
        geometry.setAttribute('shine', new three.InstancedBufferAttribute(shines(), 2));
        lightInstances(material);
        this.mesh = new three.InstancedMesh(geometry, material, kCount);
        this.mesh.frustumCulled = false;
        this.mesh.castShadow = true;
        this.mesh.receiveShadow = true;
        // Even over the sphere (a Fibonacci lattice), from its middle to its edge.
        this.directions = Array.from({length: kCount}, (_, i) => {
            const y = 1 - 2 * (i + 0.5) / kCount;
            const turn = i * Math.PI * (3 - Math.sqrt(5));
            const r = Math.sqrt(1 - y * y);
            return new three.Vector3(r * Math.cos(turn), y, r * Math.sin(turn));
        });
        this.distances = this.directions.map((_, i) => Math.cbrt(((i * 0.618034) % 1) * 0.98 + 0.02));
    }

    /** Every fourth instance is metal, of any roughness; without a mirror all are white and diffuse. */
    mirrorBy(mirror: Mirror | null): void {
        if (mirror === this.mirror) return;
        this.mirror = mirror;
        const material = this.mesh.material as three.Material;
        this.chooseCubes = () => {};
        if (mirror === null) hideMirror(material);
        else this.chooseCubes = mirror.showOn({material, shine: 'instances', box: () => this.box});
    }

    /** Moves all instances. */
    turn(center: three.Vector3, radius: number, seconds: number): void {
        const axis = new three.Vector3(0, 1, 0);
        const matrix = new three.Matrix4();
        const size = 0.04 * radius;
        this.directions.forEach((direction, i) => {
            const place = direction.clone().applyAxisAngle(axis, 0.3 * seconds)
                              .multiplyScalar(radius * this.distances[i]).add(center);
            place.toArray(this.positions, 3 * i);
            this.mesh.setMatrixAt(i, matrix.makeScale(size, size, size).setPosition(place));
        });
        this.mesh.instanceMatrix.needsUpdate = true;
        this.box.setFromCenterAndSize(center, new three.Vector3().setScalar(2 * (radius + size)));
        this.chooseCubes();
    }

    /** Finds the light of all instances. */
    light(volume: Answers): void {
        volume.batch(this.positions, {packed: this.packed.array as Float32Array, hints: this.cells});
        this.packed.needsUpdate = true;
    }
}

/** Metalness and roughness of each instance. */
function shines(): Float32Array {
    return Float32Array.from({length: 2 * kCount}, (_, at) => {
        const i = Math.floor(at / 2);
        return at % 2 === 0 ? Number(i % 4 === 0) : i * 0.7548777 % 1;
    });
}
