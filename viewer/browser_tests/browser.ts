// SPDX-License-Identifier: Apache-2.0
// Debian's Chromium with software rendering.
import {Browser, chromium, Page} from 'playwright-core';

export interface OpenPage {
    page: Page;
    /** What the console said that was no plain report of a request that failed. */
    errors: string[];
}

let browser: Browser | null = null;

export async function launch(): Promise<Browser> {
    browser ??= await chromium.launch({
        executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
        args: ['--no-sandbox', '--disable-dev-shm-usage', '--use-angle=swiftshader',
               '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
    });
    return browser;
}

export async function close(): Promise<void> {
    await browser?.close();
    browser = null;
}

interface Options {
    width?: number;
    height?: number;
    colorScheme?: 'light' | 'dark';
    isReady?: boolean;
}

/** A page of its own; waits until it shows what it opens. */
export async function open(url: string, options: Options = {}): Promise<OpenPage> {
    const {width = 720, height = 420, colorScheme = 'light', isReady = true} = options;
    const context = await (await launch()).newContext({viewport: {width, height}, colorScheme});
    const page = await context.newPage();
    page.setDefaultTimeout(90_000);
    const errors: string[] = [];
    page.on('console', message => {
        // The browser itself reports requests that fail; what the page makes of them is tested.
        const isRequest = message.text().startsWith('Failed to load resource');
        if (message.type() === 'error' && !isRequest) errors.push(message.text());
    });
    page.on('pageerror', error => errors.push(String(error)));
    await page.goto(url);
    if (isReady) await ready(page);
    return {page, errors};
}

export async function ready(page: Page): Promise<void> {
    await page.waitForFunction(() => document.body.dataset.state === 'ready');
}

type Shown = {tetralight: {viewer: {stage: {drawNow(): void; canvas: HTMLCanvasElement;
    pageFrom(v: unknown): {x: number; y: number}}}; query: {object: {ball: {position: unknown}}; position: number[]}}};

/** Where the ball is in the page. */
export function ballPlace(page: Page): Promise<{x: number; y: number}> {
    return page.evaluate(() => {
        const {viewer, query} = (window as unknown as Shown).tetralight;
        return viewer.stage.pageFrom(query.object.ball.position);
    });
}

/** The mean colour, 0 to 255, of a few pixels of the canvas around a place of the page. */
export function colorAt(page: Page, place: {x: number; y: number}): Promise<number[]> {
    return page.evaluate(({x, y}) => {
        const {stage} = (window as unknown as Shown).tetralight.viewer;
        stage.drawNow();  // in this task the canvas still has its picture
        const box = stage.canvas.getBoundingClientRect();
        const scale = stage.canvas.width / box.width;
        const copy = document.createElement('canvas');
        copy.width = copy.height = 3;
        const context = copy.getContext('2d')!;
        context.drawImage(stage.canvas, (x - box.left) * scale - 1, (y - box.top) * scale - 1, 3, 3, 0, 0, 3, 3);
        const {data} = context.getImageData(0, 0, 3, 3);
        return [0, 1, 2].map(c => [...data].filter((_, i) => i % 4 === c).reduce((sum, v) => sum + v, 0) / 9);
    }, place);
}
