// SPDX-License-Identifier: Apache-2.0
// Sets of probes in and around the courtyard.
import type {Group} from './command.js';
import {makeRandom} from './random.js';

type Position = [number, number, number];

const scattered = (count: number, seed: number, place: (random: () => number) => Position): Position[] => {
    const random = makeRandom(seed);
    return Array.from({length: count}, () => place(random));
};

function lattice(size: Position, place: (x: number, y: number, z: number) => Position): Position[] {
    const positions: Position[] = [];
    for (let x = 0; x < size[0]; ++x) {
        for (let y = 0; y < size[1]; ++y) {
            for (let z = 0; z < size[2]; ++z) positions.push(place(x, y, z));
        }
    }
    return positions;
}

const group = (positions: Position[]): Group[] => [{name: 'probes', positions}];

/** The dimensions, and what is hard for each: cospherical probes, slivers, an origin far from zero. */
export const kSets: Record<string, Group[]> = {
    point: group([[0, 1, 0]]),
    line: group([[0, 1, 0], [1, 1, 0.5], [4, 1, 2], [-5, 1, -2.5]]),
    plane: group(scattered(30, 1, random => [18 * random() - 9, 1.5, 18 * random() - 9])),
    lattice: group(lattice([6, 3, 6], (x, y, z) => [2 * x - 5, 1.5 * y + 0.5, 2 * z - 5])),
    scattered: group(scattered(150, 2, random => [18 * random() - 9, 4 * random() + 0.25, 18 * random() - 9])),
    flat: group(scattered(60, 3, random => [18 * random() - 9, 1.5 + 1e-5 * random(), 18 * random() - 9])),
    far: group(scattered(60, 4, random => [1e5 + 18 * random(), 4 * random(), -3e5 + 18 * random()])),
};

/** Two rooms on layers of their own. */
export const kRooms: Group[] = [
    {name: 'left', rendering_layers: [0], positions: lattice([3, 3, 5], (x, y, z) => [2 * x - 6, 1.5 * y + 0.5, 2 * z - 4])},
    {name: 'right', rendering_layers: [1, 2], positions: lattice([3, 3, 5], (x, y, z) => [2 * x + 1, 1.5 * y + 0.5, 2 * z - 4])},
];
