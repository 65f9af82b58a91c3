// SPDX-License-Identifier: Apache-2.0
// The conformance vectors (docs/how_to_query.md#conformance-vectors): the same answers in every language.
import {existsSync, readdirSync, readFileSync} from 'node:fs';
import {join} from 'node:path';

import {describe, expect, test} from 'vitest';

import {irradiance, QueryOptions, read, Volume} from '../src/index.js';

const kVectors = process.env.TETRALIGHT_VECTORS ?? join(__dirname, '../../../tests/conformance/vectors');

type Number = number | 'nan' | 'inf' | '-inf';

interface Answer {
    position: Number[];
    normal?: number[];
    kind: string;
    cell: number | null;
    probes: number[];
    barycentric: number[];
    weights: number[];
    ambient: number;
    irradiance_sh: number[][];
    occlusion: number[];
    irradiance: number[][];
}

interface Options {
    precision?: 'half' | 'full';
    outside?: QueryOptions['outside'];
    fade_distance?: number;
    walls?: QueryOptions['walls'];
    rendering_layers?: number;
    radius?: number;
    normal_offset?: number;
    layer_weights?: number[];
}

interface Vectors {
    largest_light: number;
    normals: number[][];
    cases: {options: Options; answers: Answer[]}[];
}

/** Decimals stand for 32-bit floats. */
const floatOf = (value: Number) =>
    typeof value === 'number' ? Math.fround(value) : {'nan': NaN, 'inf': Infinity, '-inf': -Infinity}[value];

function open(name: string, options: Options): Volume {
    const volume = read(readFileSync(join(kVectors, `${name}.probes`)), {precision: options.precision ?? 'half'});
    const weights = options.layer_weights;
    if (weights) volume.setWeights(Object.fromEntries(volume.layers.map((layer, i) => [layer.name, weights[i]])));
    return volume;
}

function queryOptions(options: Options, answer: Answer): QueryOptions {
    const all = {outside: options.outside, fadeDistance: options.fade_distance, walls: options.walls,
                 renderingLayers: options.rendering_layers, radius: options.radius,
                 normal: options.normal_offset === undefined ? undefined : answer.normal?.map(floatOf),
                 normalOffset: options.normal_offset};
    return Object.fromEntries(Object.entries(all).filter(([, value]) => value !== undefined));
}

/** The largest difference of weights, by probe. */
function weightError(ours: {probes: number[]; weights: number[]}, probes: number[], weights: number[]): number {
    const sums = new Map<number, number>();
    const add = (probe: number, weight: number) => sums.set(probe, (sums.get(probe) ?? 0) + weight);
    ours.probes.forEach((probe, i) => add(probe, ours.weights[i]));
    probes.forEach((probe, i) => add(probe, -weights[i]));
    return Math.max(0, ...[...sums.values()].map(Math.abs));
}

const largest = (a: ArrayLike<number>, b: readonly number[]) => Math.max(...b.map((value, i) => Math.abs(value - a[i])));

const files = existsSync(kVectors) ? readdirSync(kVectors) : [];
const names = files.filter(file => file.endsWith('.json')).map(file => file.slice(0, -5));

describe.skipIf(names.length === 0)('conformance', () => {
    test.each(names)('%s', name => {
        const text = readFileSync(join(kVectors, `${name}.json`), 'utf8');
        const {largest_light: unit, normals, cases} = JSON.parse(text) as Vectors;
        for (const {options, answers} of cases) {
            const volume = open(name, options);
            // Relit light of halves is rounded to halves again by the library, and not by this package.
            const isRounded = options.layer_weights && options.precision !== 'full' && volume.data.compact.length > 0;
            const tolerance = unit * (isRounded ? 2 ** -11 : 1e-5);
            for (const answer of answers) {
                const where = `${answer.kind} ${JSON.stringify(answer.position)} ${JSON.stringify(options)}`;
                const position = answer.position.map(floatOf);
                const light = volume.light(position, queryOptions(options, answer));
                expect(largest(light.sh, answer.irradiance_sh.flat()), where).toBeLessThanOrEqual(tolerance);
                normals.forEach((normal, i) => {
                    const error = largest(irradiance(light.sh, normal), answer.irradiance[i]);
                    expect(error, where).toBeLessThanOrEqual(tolerance);
                });
                expect(largest(light.occlusion, answer.occlusion), where).toBeLessThanOrEqual(2e-5);
                expect(Math.abs(light.ambient - answer.ambient), where).toBeLessThanOrEqual(2e-5);
                expect(weightError(light, answer.probes, answer.weights), where).toBeLessThanOrEqual(2e-5);
            }
        }
    });
});
