// SPDX-License-Identifier: Apache-2.0
// Frames of 100 000 balls, with and without the light of probes, as `window.page`.
import * as three from 'three';

import {read} from '../src/index.js';
import {ProbeVolume} from '../src/three/index.js';

const kSize = [960, 540] as const;
const kRadius = 0.02;

export interface Times {
    lit: number[];
    plain: number[];
    /** Of those with probes, finding the light of what moved. */
    update: number[];
}

const renderer = new three.WebGLRenderer();
renderer.setPixelRatio(1);
renderer.setSize(...kSize);
document.body.append(renderer.domElement);

/** Waits until the picture is done, and returns a pixel of its middle. */
function finish(): Uint8Array {
    const pixel = new Uint8Array(4);
    const gl = renderer.getContext();
    gl.readPixels(kSize[0] / 2, kSize[1] / 2, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    return pixel;
}

class Balls {
    readonly scene = new three.Scene();
    readonly mesh: three.InstancedMesh;
    private readonly matrix = new three.Matrix4();

    constructor(readonly count: number, private readonly places: Float32Array) {
        const ball = new three.SphereGeometry(kRadius, 6, 2);  // 12 triangles
        this.mesh = new three.InstancedMesh(ball, new three.MeshLambertMaterial(), count);
        this.mesh.frustumCulled = false;
        this.scene.add(this.mesh, new three.AmbientLight(0xffffff, 0.2));
        this.move(count, 0);
    }

    /** Moves `moving` balls, spread over all. */
    move(moving: number, frame: number): void {
        const step = Math.floor(this.count / moving);
        for (let k = 0; k < moving; ++k) {
            const i = k * step;
            const [x, y, z] = this.places.subarray(3 * i, 3 * i + 3);
            this.mesh.setMatrixAt(i, this.matrix.makeTranslation(x + 0.1 * Math.sin(frame + i), y, z));
        }
        this.mesh.instanceMatrix.needsUpdate = true;
    }
}

/** Balls on a lattice in a box. */
function placesIn(low: readonly number[], high: readonly number[], count: number): Float32Array {
    const side = Math.ceil(Math.cbrt(count));
    const places = new Float32Array(3 * count);
    for (let i = 0; i < count; ++i) {
        [i % side, Math.floor(i / side) % side, Math.floor(i / side / side)].forEach((k, axis) => {
            places[3 * i + axis] = low[axis] + (k + 0.5) / side * (high[axis] - low[axis]);
        });
    }
    return places;
}

/** Frames with probes and without them in turn. */
function run(base64: string, low: readonly number[], high: readonly number[], count: number, moving: number,
             frames: number): Times {
    const volume = read(Uint8Array.from(atob(base64), c => c.charCodeAt(0)));
    const places = placesIn(low, high, count);
    const [lit, plain] = [new Balls(count, places), new Balls(count, places)];
    const probes = new ProbeVolume(volume);
    probes.add(lit.scene);
    const camera = new three.PerspectiveCamera(50, kSize[0] / kSize[1], 0.1, 100);
    const middle = low.map((x, axis) => (x + high[axis]) / 2);
    camera.position.set(middle[0], high[1] + 1, high[2] + 2 * (high[0] - low[0]) / 3);
    camera.lookAt(middle[0], middle[1], middle[2]);
    const times: Times = {lit: [], plain: [], update: []};
    for (let frame = 0; frame < frames + 2; ++frame) {
        const isWarm = frame >= 2;
        for (const kind of ['lit', 'plain'] as const) {
            const balls = kind === 'lit' ? lit : plain;
            finish();
            const begin = performance.now();
            balls.move(moving, frame);
            balls.scene.updateMatrixWorld();
            const moved = performance.now();
            if (kind === 'lit') probes.update();
            const updated = performance.now();
            renderer.render(balls.scene, camera);
            finish();
            if (isWarm) times[kind].push(performance.now() - begin);
            if (isWarm && kind === 'lit') times.update.push(updated - moved);
        }
    }
    probes.remove(lit.scene);
    return times;
}

export const page = {run};
Object.assign(window, {page});
