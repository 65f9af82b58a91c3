// SPDX-License-Identifier: Apache-2.0
// What the tests run in the browser, as `window.page`, with WebGLRenderer.
import * as three from 'three';

import {ProbeVolume, ProbeVolumeHelper, toLightProbeGrid} from '../src/three/index.js';
import {cameraAt, kSize, Square, Squares, vector} from './three_squares.js';
import {kit, renderer} from './three_webgl_kit.js';

class Page extends Squares {
    /** Squares lit by the grid of three.js in a box. */
    async grid({volume}: ProbeVolume, squares: readonly Square[], low: readonly number[], high: readonly number[],
               resolution: readonly [number, number, number]): Promise<number[][]> {
        const scene = new three.Scene();
        const light = toLightProbeGrid(volume, new three.Box3(vector(low), vector(high)), resolution);
        scene.add(light);
        const material = new three.MeshLambertMaterial({color: new three.Color(0.5, 0.5, 0.5)});
        const geometry = new three.PlaneGeometry(1, 1);
        const colors = [];
        for (const square of squares) {
            const mesh = new three.Mesh(geometry, material);
            mesh.position.copy(vector(square.position));
            mesh.quaternion.setFromUnitVectors(new three.Vector3(0, 0, 1), vector(square.normal));
            scene.add(mesh);
            colors.push(await this.color(scene, square));
            scene.remove(mesh);
        }
        light.dispose();
        return colors;
    }

    /** Balls of the helper in the middle of a picture, before and after the weights change, and what it draws. */
    async helper({volume}: ProbeVolume, probes: readonly number[], normal: readonly number[], weights: Record<string, number>) {
        const before = {...renderer.info.memory};
        const helper = new ProbeVolumeHelper(volume, {radius: 0.05});
        const scene = new three.Scene().add(helper);
        const colors = async () => {
            const all = [];
            for (const i of probes) {
                const pixels = await kit.readPixels(scene, cameraAt({position: volume.position(i), normal}, 0.005, 0.1));
                all.push([...pixels.subarray(4 * (kSize * kSize / 2 + kSize / 2)).subarray(0, 3)]);
            }
            return all;
        };
        helper.cells.visible = false;
        const full = await colors();
        volume.setWeights(weights);
        helper.update();
        const dimmed = await colors();
        helper.cells.visible = true;
        renderer.render(scene, cameraAt({position: volume.position(0), normal}, 10, 10));
        const lines = renderer.info.render.lines;
        const ends = helper.cells.geometry.index!.array;
        helper.dispose();
        return {full, dimmed, lines, edges: ends.length / 2, before, after: {...renderer.info.memory}};
    }
}

export const page = new Page(kit);
Object.assign(window, {page});
