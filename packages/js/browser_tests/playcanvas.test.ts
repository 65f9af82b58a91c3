// SPDX-License-Identifier: Apache-2.0
// Entities of PlayCanvas against the light of the volume.
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

describe.skipIf(!kCanRun)('in PlayCanvas', () => {
    let lit: Lit;
    let page: Page;
    beforeAll(async () => {
        lit = makeSquares(folder.bake(undefined, '--layers', 'sun,sky'));
        browser = await launch();
        page = await openPage(browser, 'playcanvas_page.ts');
    });

    test.each(['objects', 'refreshed', 'sky', 'materials'])('squares have the light of probes: %s', async way => {
        expectRounded(lit, await shade(page, lit, way));
    });
});
