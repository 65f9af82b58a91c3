// SPDX-License-Identifier: Apache-2.0
// Chromium with software rendering, and pages that run one file of this folder.
import {existsSync, readFileSync} from 'node:fs';
import {join} from 'node:path';

import {build} from 'esbuild';
import {Browser, chromium, Page} from 'playwright-core';

import {kCommand, kCourtyard} from '../tests/command.js';

export const kRoot = join(__dirname, '..');
const kChromium = process.env.CHROMIUM ?? '/usr/bin/chromium';

/** Whether the tests of engines can run. */
export const kCanRun = kCommand !== '' && kCourtyard !== '' && existsSync(kChromium);

export function launch(): Promise<Browser> {
    return chromium.launch({executablePath: kChromium, args: [
        '--no-sandbox', '--disable-dev-shm-usage', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
        '--ignore-gpu-blocklist']});
}

/** The code of a script and all of its imports that it uses. */
export async function bundle(entry: string): Promise<string> {
    const {outputFiles} = await build({
        absWorkingDir: kRoot, entryPoints: [entry], bundle: true, write: false, format: 'iife', target: 'es2022',
        define: {'process.env.NODE_ENV': '"production"'}, logLevel: 'error',
    });
    return outputFiles[0].text;
}

/** A page with a canvas of 8 × 8 pixels that has run the bundle of `entry`. Other addresses serve `files`. */
export async function openPage(browser: Browser, entry: string, files: Record<string, string> = {}): Promise<Page> {
    const page = await (await browser.newContext()).newPage();
    const scripts = Object.keys(files).filter(name => name.endsWith('.js')).map(name => `<script src="/${name}"></script>`);
    const html = `<!doctype html><canvas width="8" height="8" style="width: 8px; height: 8px"></canvas>${scripts.join('')}`;
    await page.route('http://page.test/**', route => {
        const name = new URL(route.request().url()).pathname.slice(1);
        if (name === '') return route.fulfill({contentType: 'text/html', body: html});
        if (!(name in files)) return route.fulfill({status: 404});
        const contentType = name.endsWith('.wasm') ? 'application/wasm' : 'text/javascript';
        return route.fulfill({contentType, body: readFileSync(files[name])});
    });
    page.on('pageerror', error => console.error(error));
    await page.goto('http://page.test/');
    await page.addScriptTag({content: await bundle(join(__dirname, entry))});
    return page;
}
