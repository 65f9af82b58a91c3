// SPDX-License-Identifier: Apache-2.0
// Balls as instances of one mesh, each with the light of its own place. Some of them move.
import * as three from 'three';

import {parameter, say, Stage, start} from './stage.js';

/** Centers on a lattice in a box. */
function latticeIn(box: three.Box3, count: number): three.Vector3[] {
    const side = Math.ceil(Math.cbrt(count));
    const size = box.getSize(new three.Vector3());
    return Array.from({length: count}, (_, i) => {
        const place = new three.Vector3(i % side, Math.floor(i / side) % side, Math.floor(i / side / side));
        return place.addScalar(0.5).divideScalar(side).multiply(size).add(box.min);
    });
}

function begin({probes, scene, box, run}: Stage): void {
    const count = parameter('count', 1023);
    const moving = Math.min(count, parameter('moving', 1000));
    const places = latticeIn(box, count);
    const size = box.getSize(new three.Vector3());
    const radius = 0.25 * Math.min(size.x, size.y, size.z) / Math.cbrt(count);
    // The more balls there are, the fewer triangles each has.
    const ball = count > 10_000 ? new three.SphereGeometry(radius, 6, 2) : new three.SphereGeometry(radius, 24, 16);
    const mesh = new three.InstancedMesh(ball, new three.MeshStandardMaterial({color: 0xffffff, roughness: 1}), count);
    const matrix = new three.Matrix4();
    const put = (i: number, {x, y, z}: three.Vector3, up: number) => mesh.setMatrixAt(i, matrix.makeTranslation(x, y + up, z));
    places.forEach((place, i) => put(i, place, 0));
    mesh.frustumCulled = false;
    scene.add(mesh);
    mesh.updateMatrixWorld();
    probes.add(mesh);
    const step = Math.floor(count / moving);
    let last = performance.now();
    run(time => {
        for (let k = 0; k < moving; ++k) put(k * step, places[k * step], 4 * radius * Math.sin(2 * time + k));
        mesh.instanceMatrix.needsUpdate = true;
        const now = performance.now();
        say(`${count} balls, ${moving} of them move: ${(now - last).toFixed(0)} ms a frame`);
        last = now;
    });
}

start(begin);
