// SPDX-License-Identifier: Apache-2.0
// What squares of metal mirror in three.js against the texels of the cube.
import {afterAll, beforeAll, describe, expect, test} from 'vitest';

import {floatOfHalf} from '../src/half.js';
import {irradiance, LayerWeights, levelRoughness, readReflections, Reflections} from '../src/index.js';
import {Folder, kCourtyard} from '../tests/command.js';
import {makeRandom} from '../tests/random.js';
import {kCanRun} from './open_page.js';
import {TestPage} from './three_browser.js';
import type {Mirror, page as PageOfBrowser} from './three_reflection_page.js';

type Window = {page: typeof PageOfBrowser};
type Vector = number[];

const dot = (a: Vector, b: Vector) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const luminance = (rgb: Vector) => dot(rgb, [0.2126, 0.7152, 0.0722]);

/** Face and place in it, from -1 to 1, of a direction (OpenGL). Undefined near an edge, where faces blend. */
function faceOf(d: Vector, size: number): {face: number; x: number; y: number} | undefined {
    const axis = [0, 1, 2].reduce((best, i) => Math.abs(d[i]) > Math.abs(d[best]) ? i : best);
    const sign = Math.sign(d[axis]);
    const [x, y] = axis === 0 ? [-sign * d[2], -d[1]] : axis === 1 ? [d[0], sign * d[2]] : [sign * d[0], -d[1]];
    const place = [x, y].map(c => ((c / Math.abs(d[axis]) + 1) / 2) * size - 0.5);
    if (place.some(c => c < 0 || c > size - 1)) return undefined;
    return {face: 2 * axis + (sign < 0 ? 1 : 0), x: place[0], y: place[1]};
}

describe.skipIf(!kCanRun)('reflection probes in three.js', () => {
    const folder = new Folder();
    let opened: TestPage;
    let baked: Reflections;
    let base64: string;
    beforeAll(async () => {
        folder.run('reflect', kCourtyard, '--box', '-4,0,-4,4,3,4', '-o', 'court.ktx2', '--cube-size', '32', '--samples', '4',
                   '--no-sky', '--layers', 'sun,sky', '--quiet');
        const bytes = folder.bytes('court.ktx2');
        base64 = Buffer.from(bytes).toString('base64');
        baked = readReflections(bytes);
        opened = await TestPage.open('three_reflection_page.ts');
    });
    afterAll(async () => {
        folder.remove();
        await opened?.close();
    });

    /** Radiance of level `level` towards where the mirrored ray of a square ends at the box. */
    function mirrored({position, normal, toEye}: Mirror, level: number, reflections: Reflections): Vector | undefined {
        const {position: from, boxCenter, halfSize} = reflections.probes[0];
        const n = [...normal], eye = [...toEye];
        const ray = n.map((c, i) => 2 * dot(n, eye) * c - eye[i]);
        const middle = from.map((c, i) => c + boxCenter[i]);
        const reach = Math.min(...ray.map((c, i) => (Math.sign(c) * halfSize[i] + middle[i] - position[i]) / c));
        const size = reflections.size >> level;
        const place = faceOf(ray.map((c, i) => position[i] + c * reach - from[i]), size);
        if (!place) return undefined;
        const texels = reflections.texels(0, level);
        const [left, top] = [Math.floor(place.x), Math.floor(place.y)];
        const [s, t] = [place.x - left, place.y - top];
        return [0, 1, 2].map(channel => {
            const texel = (x: number, y: number) => floatOfHalf(texels[
                4 * ((place.face * size + Math.min(y, size - 1)) * size + Math.min(x, size - 1)) + channel]);
            const row = (y: number) => texel(left, y) * (1 - s) + texel(left + 1, y) * s;
            return row(top) * (1 - t) + row(top + 1) * t;
        });
    }

    /** Squares in the box, seen from any side. */
    function makeMirrors(seed: number): Mirror[] {
        const random = makeRandom(seed);
        const direction = () => {
            const d = [random() - 0.5, random() - 0.5, random() - 0.5];
            return d.map(c => c / Math.hypot(...d));
        };
        return Array.from({length: 80}, () => {
            const normal = direction();
            const toEye = direction();
            const isFront = dot(normal, toEye) > 0;
            return {position: [6 * random() - 3, 0.5 + 2 * random(), 6 * random() - 3], normal,
                    toEye: isFront ? toEye : toEye.map(c => -c)};
        }).filter(({normal, toEye}) => dot(normal, toEye) > 0.5);
    }

    async function compare(level: number, ambient: number, reflections = baked, weights?: LayerWeights): Promise<void> {
        const roughness = levelRoughness(level, reflections.levelCount);
        const mirrors = makeMirrors(60 + level);
        const colors = await opened.page.evaluate(([file, all, rough, light, changed]) => {
            const {page} = window as unknown as Window;
            return page.mirror(file, all, rough, light, changed);
        }, [base64, mirrors, roughness, ambient, weights] as const);
        // Specular reflectance of white metal: three.js adds what facets reflect more than once to environments only.
        const shares: number[] = [];
        mirrors.forEach((each, i) => {
            const light = mirrored(each, level, reflections);
            if (!light) return;
            const there = luminance(irradiance(reflections.probes[0].sh, each.normal));
            const step = Math.min(Math.max((roughness - 0.1) / 0.4, 0), 1);
            const smooth = step * step * (3 - 2 * step);
            const occlusion = ambient > 0 ? 1 + (Math.min(ambient / there, 1) - 1) * smooth : 1;
            shares.push(luminance(colors[i]) / (luminance(light) * occlusion));
        });
        expect(shares.length).toBeGreaterThan(20);
        shares.forEach(share => expect(share).toBeGreaterThan(level === 0 ? 0.97 : 0.8));
        shares.forEach(share => expect(share).toBeLessThan(1.02));
    }

    test('a mirror shows level 0, projected on the box', async () => compare(0, 0));

    test('rough metal shows the level of its roughness', async () => compare(1, 0));

    test('rough metal in the dark shows less', async () => compare(1, 0.2));

    test('the weights of layers change what is mirrored, as `tetralight relight` does', async () => {
        folder.run('relight', 'court.ktx2', '-o', 'relit.ktx2', '--weights', 'sun=0.25,sky=2', '--quiet');
        await compare(1, 0.2, readReflections(folder.bytes('relit.ktx2')), {sun: 0.25, sky: 2});
    });

    test('leave no errors or warnings', () => {
        expect(opened.problems).toEqual([]);
    });
});
