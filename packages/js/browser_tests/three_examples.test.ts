// SPDX-License-Identifier: Apache-2.0
// The pages of examples/: they have no errors, are not black, and change with time.
import {mkdirSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';

import type {Browser, Page} from 'playwright-core';
import {createServer, ViteDevServer} from 'vite';
import {afterAll, beforeAll, describe, expect, test} from 'vitest';

import {Folder, kCourtyard} from '../tests/command.js';
import {kCanRun, launch} from './open_page.js';

const kExamples = join(__dirname, '../examples');

describe.skipIf(!kCanRun)('examples of three.js', () => {
    const folder = new Folder();
    let server: ViteDevServer;
    let browser: Browser;
    let page: Page;
    let problems: string[];
    beforeAll(async () => {
        mkdirSync(folder.file('public'));
        const layers = ['--layers', 'sun,sky', '--samples', '16', '--quiet'];
        folder.run('bake', kCourtyard, '-o', 'public/court.probes', ...layers);
        folder.run('lightmap', kCourtyard, '-o', 'public/court.lightmaps', '--unwrapped', 'public/court.glb',
                   '--texels-per-meter', '1', '--page-size', '256', ...layers);
        server = await createServer({configFile: join(kExamples, 'vite.config.ts'), publicDir: folder.file('public'),
                                     cacheDir: folder.file('cache'), logLevel: 'error', server: {port: 0, host: '127.0.0.1'}});
        await server.listen();
        browser = await launch();
        page = await (await browser.newContext({viewport: {width: 320, height: 180}})).newPage();
        page.on('pageerror', error => problems.push(error.message));
        page.on('console', message => { if (message.type() === 'error') problems.push(message.text()); });
    });
    afterAll(async () => {
        await browser?.close();
        await server?.close();
        folder.remove();
    });

    /** The picture at a second, RGBA. */
    async function show(name: string, time: number, more = ''): Promise<number[]> {
        const {port} = server.httpServer!.address() as {port: number};
        const files = 'scene=court.glb&probes=court.probes&lightmaps=court.lightmaps';
        await page.goto(`http://127.0.0.1:${port}/${name}.html?${files}&time=${time}${more}`);
        await page.waitForFunction(() => Number(document.body.dataset.frames) > 1, undefined, {timeout: 120_000});
        const png = await page.screenshot({style: '#status { display: none }'});
        if (process.env.TETRALIGHT_PICTURES) writeFileSync(`${process.env.TETRALIGHT_PICTURES}/${name}_${time}.png`, png);
        return page.evaluate(async base64 => {
            const bytes = Uint8Array.from(atob(base64), c => c.charCodeAt(0));
            const picture = await createImageBitmap(new Blob([bytes]));
            const canvas = document.createElement('canvas');
            canvas.width = picture.width;
            canvas.height = picture.height;
            const context = canvas.getContext('2d')!;
            context.drawImage(picture, 0, 0);
            return [...context.getImageData(0, 0, canvas.width, canvas.height).data];
        }, png.toString('base64'));
    }

    test.each([['character', 0, 2, ''], ['balls', 0, 0.7, ''], ['balls', 0, 0.7, '&count=20000&moving=20000'],
               ['day', 15, 45, '']] as [string, number, number, string][])(
        '%s.html draws, and changes with time', async (name, early, late, more) => {
            problems = [];
            const [before, after] = [await show(name, early, more), await show(name, late, more)];
            expect(problems).toEqual([]);
            const bright = (picture: number[]) => picture.filter((value, i) => i % 4 < 3 && value > 32).length;
            expect(bright(before)).toBeGreaterThan(before.length / 4);
            const changed = before.filter((value, i) => Math.abs(value - after[i]) > 8).length;
            expect(changed).toBeGreaterThan(100);
        });

    test('a day is brighter than a night', async () => {
        problems = [];
        const sum = (picture: number[]) => picture.reduce((total, value) => total + value, 0);
        const [noon, night] = [sum(await show('day', 7.5)), sum(await show('day', 37.5))];
        expect(noon - night).toBeGreaterThan(0.3 * noon);
    });
});
