// SPDX-License-Identifier: Apache-2.0
// `./run bench viewer`: one JSON object a line, as the other benchmarks print them.
import {readFileSync, readdirSync} from 'node:fs';
import {join} from 'node:path';
import {gzipSync} from 'node:zlib';

import {ballPlace, close, open} from '../browser_tests/browser';
import {kViewer, Server} from '../browser_tests/server';

const kRepeats = 7;

const sorted = (values: number[]) => [...values].sort((a, b) => a - b);
const median = (values: number[]) => sorted(values)[values.length >> 1];
const print = (figure: string, ours: number, unit: string, more: Record<string, unknown> = {}) =>
    console.log(JSON.stringify({figure, ours: Number(ours.toPrecision(4)), unit, ...more}));

function bundle(): void {
    const files = readdirSync(join(kViewer, 'assets')).filter(name => /\.(js|css)$/.test(name));
    const bytes = files.reduce((sum, name) => sum + gzipSync(readFileSync(join(kViewer, 'assets', name))).length, 0);
    print('viewer.bundle', bytes / 1000, 'kB, gzipped');
}

/** From navigation until the courtyard with its volume is drawn and answers. */
async function load(server: Server): Promise<void> {
    const seconds: number[] = [];
    for (let i = 0; i < kRepeats; ++i) {
        const start = performance.now();
        const page = await open(server.url, {width: 960, height: 540});
        await page.evaluate(() => new Promise(drawn => requestAnimationFrame(drawn)));
        seconds.push((performance.now() - start) / 1000);
        await page.context().close();
    }
    print('viewer.load', median(seconds), 's');
}

type Query = {tetralight: {query: {times: number[]}}};

async function drag(server: Server): Promise<void> {
    const view = '/#tab=query&eye=0,24,4.01&target=0,0,4&object=0,1.5,0';
    const page = await open(server.url + view, {width: 480, height: 320});
    const {x, y} = await ballPlace(page);
    await page.evaluate(() => { (window as unknown as Query).tetralight.query.times.length = 0; });
    await page.mouse.move(x, y);
    await page.mouse.down();
    for (let i = 0; i < 200; ++i) await page.mouse.move(x + 60 * Math.sin(i / 9), y + 40 * Math.sin(i / 7));
    await page.mouse.up();
    await page.waitForTimeout(500);
    const times = sorted(await page.evaluate(() => (window as unknown as Query).tetralight.query.times));
    print('viewer.drag', times[Math.floor(0.95 * times.length)], 'ms, p95 of queries',
          {median: Number(median(times).toFixed(2)), queries: times.length});
    await page.context().close();
}

/** All balls, against the bare scene and one plain instanced draw of the same balls. */
async function manyProbes(server: Server): Promise<void> {
    const positions: number[][] = [];
    for (let i = 0; i < 100_000; ++i) positions.push([i % 50, 0.5 + Math.floor(i / 2500), Math.floor(i / 50) % 50]);
    const groups = await server.request<{id: string}>('POST', '/v1/groups',
                                                      JSON.stringify({groups: [{name: 'many', positions}]}));
    const {id} = await server.request<{id: string}>('POST', '/v1/tetrahedralize', JSON.stringify({groups: [groups.id]}));
    const page = await open(`${server.url}/#volume=${id}&hidden=cells`, {width: 480, height: 320});
    const [ours, baseline] = await page.evaluate(repeats => {
        const {viewer} = (window as any).tetralight;  // eslint-disable-line
        const {stage, balls} = viewer;
        const {mesh} = balls;
        const plain = new mesh.constructor(mesh.geometry, new mesh.material.constructor({
            vertexShader: 'attribute vec3 center; uniform float radius; void main() { gl_Position = ' +
                'projectionMatrix * viewMatrix * vec4(center + radius * position, 1.0); }',
            fragmentShader: 'void main() { gl_FragColor = vec4(0.5, 0.5, 0.5, 1.0); }',
            uniforms: mesh.material.uniforms,
        }));
        plain.frustumCulled = false;
        const gl = stage.renderer.getContext();
        const frame = (shown: unknown, hidden: {removeFromParent(): void}) => {
            hidden.removeFromParent();
            stage.scene.add(shown);
            const start = performance.now();
            stage.drawNow();
            gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));  // waits for it
            return performance.now() - start;
        };
        const times: number[][] = [[], []];
        for (let i = 0; i <= repeats; ++i) {
            const pair = [frame(mesh, plain), frame(plain, mesh)];
            if (i > 0) pair.forEach((time, k) => times[k].push(time));  // the first compiles shaders
        }
        return times;
    }, kRepeats);
    print('viewer.probes_100k', median(ours), 'ms a frame', {
        baseline: Number(median(baseline).toPrecision(4)),
        ratio: Number((median(ours) / median(baseline)).toPrecision(3)),
        baseline_is: 'the bare scene and one plain instanced draw of the same balls',
    });
    await page.context().close();
}

const server = await new Server().start();
try {
    const scene = await server.uploadCourtyard();
    await server.bake({scene, samples: 1024, name: 'courtyard'});
    bundle();
    await load(server);
    await drag(server);
    await manyProbes(server);
} finally {
    await close();
    await server.end();
}
