// SPDX-License-Identifier: Apache-2.0
// The page with one ball in four engines, beside pictures of the command. TETRALIGHT_GALLERY_PICTURE names a file for a
// picture of it.
import {mkdirSync} from 'node:fs';
import {join} from 'node:path';

import type {Browser, Page} from 'playwright-core';
import {build, preview, PreviewServer} from 'vite';
import {afterAll, beforeAll, describe, expect, test} from 'vitest';

import type {Gallery} from '../gallery/main.js';
import {makeInput} from '../gallery/make_input.js';
import {kStations} from '../gallery/road.js';
import {Folder, kCommand, kCourtyard} from '../tests/command.js';
import {kCanRun, kRoot, launch} from './open_page.js';

const kRows = 5;  // four engines and the command

const folder = new Folder();
let browser: Browser | undefined;
let server: PreviewServer | undefined;
afterAll(async () => {
    await browser?.close();
    await server?.close();
    folder.remove();
});

describe.skipIf(!kCanRun)('the gallery', () => {
    let page: Page;
    let gallery: Gallery;
    beforeAll(async () => {
        const [root, outDir] = [join(kRoot, 'gallery'), folder.file('page')];
        const configFile = join(root, 'vite.config.ts');
        await build({root, configFile, publicDir: false, logLevel: 'error', build: {outDir}});
        mkdirSync(join(outDir, 'files'));
        makeInput(kCommand, kCourtyard, join(outDir, 'files'), '--samples', '64');
        server = await preview({root, configFile, logLevel: 'error', build: {outDir}, preview: {port: 0, host: '127.0.0.1'}});
        browser = await launch();
        page = await browser.newPage({viewport: {width: 1160, height: 1030}});
        page.on('pageerror', error => console.error(error));
        await page.goto(`${server.resolvedUrls!.local[0]}?volume=files/court.probes&still`);
        await page.waitForFunction(() => 'gallery' in window, undefined, {timeout: 200_000});
        gallery = await page.evaluate(() => (window as unknown as {gallery: Gallery}).gallery);
    });

    test('shows all engines and the command', () => {
        expect(gallery.names.map(name => name.split(' ')[0]))
            .toEqual(['three.js', 'PlayCanvas', 'Filament', 'Babylon', 'tetralight']);
        expect(gallery.means.map(row => row.length)).toEqual(Array<number>(kRows).fill(kStations.length));
    });

    // Pictures of the command were rounded twice. PlayCanvas encodes colors by the power of 1 / 2.2 in place of the curve of
    // sRGB, which brightens dark colors and darkens bright ones.
    test('has balls whose mean colors differ by 1 / 255 at most, those of PlayCanvas by 3 / 255', () => {
        const wanted = gallery.means[gallery.names.indexOf('tetralight render')];
        gallery.means.forEach((row, i) => {
            const tolerance = gallery.names[i].startsWith('PlayCanvas') ? 3 : 1;
            row.forEach((mean, station) => mean.forEach((value, channel) => {
                const what = `${gallery.names[i]}, ${kStations[station].name}, channel ${channel}`;
                expect(Math.abs(value - wanted[station][channel]), what).toBeLessThan(tolerance);
            }));
        });
    });

    test('has balls whose light differs from station to station', () => {
        const [red, blue] = [0, 2].map(channel => gallery.means[0].map(mean => mean[channel]));
        const lamp = kStations.findIndex(({name}) => name === 'orange lamp');
        const lawn = kStations.findIndex(({name}) => name === 'lawn');
        expect(red[lamp]).toBeGreaterThan(blue[lamp]);
        expect(blue[lawn]).toBeGreaterThan(red[lawn]);
    });

    test('has a picture of its scene', async () => {
        const path = process.env.TETRALIGHT_GALLERY_PICTURE;
        const picture = await page.screenshot(path ? {path, fullPage: true} : {fullPage: true});
        expect(picture.length).toBeGreaterThan(100_000);
    });
});
