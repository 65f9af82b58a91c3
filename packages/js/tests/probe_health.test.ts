// SPDX-License-Identifier: Apache-2.0
import {afterAll, describe, expect, test} from 'vitest';

import {read} from '../src/index.js';
import {Folder, Group, kCommand, kCourtyard} from './command.js';
import {Entry, sectionsOf, sign} from './sections.js';

const folder = new Folder();
afterAll(() => folder.remove());

const kGroups: Group[] = [{name: 'a', positions: [[0, 1, 0], [2, 1, 0], [0, 3, 0]]}];

describe.skipIf(kCommand === '' || kCourtyard === '')('the health of probes', () => {
    test('has the meaning of its bytes', () => {
        const bytes = folder.bake(kGroups);
        const section = sectionsOf(bytes).find(({name}) => name === 'health') as Entry;
        const view = new DataView(bytes.buffer, section.offset + 24, 24);  // of probe 1
        [0.5, 2, 3, 0, -4].forEach((value, i) => view.setFloat32(4 * i, value, true));
        view.setUint32(20, 1, true);
        sign(bytes, section);
        const health = read(bytes).health;
        expect(health).toHaveLength(3);
        expect(health[1]).toEqual({error: 0.5, surface: 2, offset: [3, 0, -4], isDilated: true});
        expect(health[0].isDilated).toBe(false);
    });

    test('is empty if the volume was not baked', () => {
        expect(read(folder.tetrahedralize(kGroups)).health).toEqual([]);
    });
});
