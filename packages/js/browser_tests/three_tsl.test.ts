// SPDX-License-Identifier: Apache-2.0
// Objects of WebGPURenderer, by its WebGL 2 backend, against the light of the volume.
import {join} from 'node:path';

import {afterAll, beforeAll, describe, expect, test} from 'vitest';

import {bundle, kCanRun} from './open_page.js';
import {LitSquares, TestPage} from './three_browser.js';
import {compareSquares} from './three_compare.js';
import {testObjects} from './three_object_tests.js';
import type {page as PageOfBrowser} from './three_tsl_page.js';

type Window = {page: typeof PageOfBrowser};

describe.skipIf(!kCanRun)('as nodes of three.js', () => {
    let lit: LitSquares;
    let opened: TestPage;
    beforeAll(async () => {
        lit = new LitSquares();
        opened = await TestPage.open('three_tsl_page.ts');
        expect(await opened.page.evaluate(() => (window as unknown as Window).page.begin())).toBe('WebGL 2');
    });
    afterAll(async () => {
        lit?.folder.remove();
        await opened?.close();
    });

    testObjects(() => ({lit, page: opened.page}), [['standard', false], ['standard', true], ['lambert', false]],
                [['standard', false], ['lambert', false], ['lambert', true]]);

    test('materials of WebGLRenderer become node materials', async () => {
        const colors = await opened.page.evaluate(([bytes, all]) => {
            const {page} = window as unknown as Window;
            page.useClassicMaterials();
            return page.meshes(page.open(bytes), 'lambert', all);
        }, [lit.base64, lit.squares] as const);
        compareSquares(lit, 'lambert', colors);
    });

    test('the page has no errors or warnings', () => {
        expect(opened.problems).toEqual([]);
    });
});

test('users of WebGLRenderer do not load WebGPURenderer', async () => {
    const classic = await bundle(join(__dirname, 'three_page.ts'));
    expect(classic).not.toContain('NodeBuilder');
});
