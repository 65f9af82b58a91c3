// SPDX-License-Identifier: Apache-2.0
// Meshes and environments of Babylon against the light of the volume, in scenes of both hands.
import type {Browser, Page} from 'playwright-core';
import {afterAll, beforeAll, describe, test} from 'vitest';

import {Folder} from '../tests/command.js';
import {kCanRun, launch, openPage} from './open_page.js';
import {expectRounded, Lit, makeSquares, shade} from './squares.js';

const folder = new Folder();
let browser: Browser | undefined;
afterAll(async () => {
    folder.remove();
    await browser?.close();
});

describe.skipIf(!kCanRun)('in Babylon', () => {
    let lit: Lit;
    let page: Page;
    beforeAll(async () => {
        lit = makeSquares(folder.bake(undefined, '--layers', 'sun,sky'));
        browser = await launch();
        page = await openPage(browser, 'babylon_page.ts');
    });

    test.each([
        'PBR, left-handed', 'PBR, right-handed', 'standard material', 'several materials', 'refreshed',
        'environment, left-handed', 'environment, right-handed',
    ])('squares have the light of probes: %s', async way => {
        expectRounded(lit, await shade(page, lit, way));
    });
});
