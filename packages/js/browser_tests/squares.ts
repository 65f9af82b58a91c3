// SPDX-License-Identifier: Apache-2.0
// What tests of engines share: squares at places of a volume, and what their pictures should be.
import type {Page} from 'playwright-core';
import {expect} from 'vitest';

import {irradiance, read, Volume} from '../src/index.js';
import {makePositions, makeRandom} from '../tests/random.js';

export interface Square {
    position: [number, number, number];
    normal: [number, number, number];
}

/** What the page of an engine gives the tests. */
export interface EnginePage {
    /** The volume, with these weights of its layers. */
    open(base64: string, weights: Record<string, number>): void;
    /** Bytes of the pixel in the middle of a white diffuse square that faces the camera, one square at a time. */
    shade(squares: readonly Square[], way: string): Promise<number[][]>;
}

/** A volume with weights so that no white square is brighter than a picture can show. */
export interface Lit {
    volume: Volume;
    base64: string;
    weights: Record<string, number>;
    squares: Square[];
}

const kPlaces = 10;
const kNormals = 8;
const kBrightest = 0.9;

/** Eight normals at each of ten places. */
export function makeSquares(bytes: Uint8Array): Lit {
    const volume = read(bytes);
    const random = makeRandom(61);
    const positions = makePositions(volume, 3 * kPlaces, 60);
    const places = Array.from({length: 3 * kPlaces}, (_, i) => [...positions.subarray(3 * i, 3 * i + 3)])
        .filter(place => Math.hypot(...place) < 1000).slice(0, kPlaces);
    const squares = places.flatMap(position => Array.from({length: kNormals}, () => {
        const normal = [random() - 0.5, random() - 0.5, random() - 0.5];
        const length = Math.hypot(...normal);
        return {position, normal: normal.map(x => x / length)} as Square;
    }));
    const largest = Math.max(...squares.flatMap(square => radiance(volume, square)));
    const weights = Object.fromEntries(volume.layers.map(({name, weight}) => [name, weight * kBrightest / largest]));
    volume.setWeights(weights);
    return {volume, base64: Buffer.from(bytes).toString('base64'), weights, squares};
}

/** Of a white diffuse surface: irradiance / π, never negative. */
export function radiance(volume: Volume, {position, normal}: Square): number[] {
    return irradiance(volume.light(position).sh, normal).map(value => Math.max(value, 0) / Math.PI);
}

export async function shade(page: Page, {base64, weights, squares}: Lit, way: string): Promise<number[][]> {
    return page.evaluate(([bytes, given, all, name]) => {
        const {engine} = window as unknown as {engine: EnginePage};
        engine.open(bytes, given);
        return engine.shade(all, name);
    }, [base64, weights, squares, way] as const);
}

/** Pictures round to whole bytes. A byte that lies between two may be rounded to each. */
export function expectRounded({volume, squares}: Lit, colors: number[][]): void {
    expect(colors).toHaveLength(squares.length);
    const errors = colors.flatMap((color, i) =>
        radiance(volume, squares[i]).map((wanted, channel) => Math.abs(color[channel] - 255 * wanted)));
    expect(Math.max(...errors)).toBeLessThan(0.55);
    // Without this a black picture of dark squares would do.
    expect(Math.max(...colors.flat())).toBeGreaterThan(200);
}
