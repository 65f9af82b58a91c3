// SPDX-License-Identifier: Apache-2.0
// Scenes of Filament against the light of the volume.
import {join} from 'node:path';

import type {Browser, Page} from 'playwright-core';
import {afterAll, beforeAll, describe, test} from 'vitest';

import {Folder} from '../tests/command.js';
import {kCanRun, kRoot, launch, openPage} from './open_page.js';
import {expectRounded, Lit, makeSquares, shade} from './squares.js';

const folder = new Folder();
let browser: Browser | undefined;
afterAll(async () => {
    folder.remove();
    await browser?.close();
});

describe.skipIf(!kCanRun)('in Filament', () => {
    let lit: Lit;
    let page: Page;
    beforeAll(async () => {
        lit = makeSquares(folder.bake(undefined, '--layers', 'sun,sky'));
        browser = await launch();
        page = await openPage(browser, 'filament_page.ts', {
            'filament.js': join(kRoot, 'node_modules/filament/filament.js'),
            'filament.wasm': join(kRoot, 'node_modules/filament/filament.wasm'),
        });
    });

    test.each(['moving', 'refreshed', 'coefficients'])('squares have the light of probes: %s', async way => {
        expectRounded(lit, await shade(page, lit, way));
    });
});
