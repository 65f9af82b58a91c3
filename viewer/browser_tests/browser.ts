// SPDX-License-Identifier: Apache-2.0
// Debian's Chromium with software rendering.
import {Browser, BrowserContext, chromium, Locator, Page} from 'playwright-core';

import {kPatience} from './patience';

export const kChromium = process.env.CHROMIUM ?? '/usr/bin/chromium';

let browser: Browser | null = null;

async function launch(): Promise<Browser> {
    browser ??= await chromium.launch({
        executablePath: kChromium,
        timeout: kPatience,
        args: ['--no-sandbox', '--disable-dev-shm-usage', '--use-angle=swiftshader',
               '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
    });
    return browser;
}

export async function close(): Promise<void> {
    await browser?.close();
    browser = null;
}

export interface Options {
    width?: number;
    height?: number;
    colorScheme?: 'light' | 'dark';
    /** What the browser says of requests that the test makes fail. */
    refusal?: RegExp;
}

/** A context of its own, so that pages share no storage. */
export async function newContext(options: Options = {}): Promise<BrowserContext> {
    const {width = 960, height = 540, colorScheme = 'light'} = options;
    const context = await (await launch()).newContext({viewport: {width, height}, colorScheme});
    context.setDefaultTimeout(kPatience);
    return context;
}

/** A page that shows what it opens. */
export async function open(url: string, options: Options = {}): Promise<Page> {
    const page = await (await newContext(options)).newPage();
    await page.goto(url);
    await ready(page);
    return page;
}

/** Waits until all that the address names is shown, or the page says why it is not. */
export async function ready(page: Page): Promise<void> {
    await page.waitForFunction(() => document.body.dataset.state === 'ready');
}

/** Waits for a picture at full resolution: pictures are coarse while something changes. */
export async function drawn(page: Page): Promise<void> {
    await page.waitForFunction(() => {
        const {width, clientWidth} = document.querySelector<HTMLCanvasElement>('#view canvas')!;
        return width >= clientWidth;
    });
}

/** What the page itself has in its address: `page.url()` hears of a change only later. */
export function addressOf(page: Page): Promise<string> {
    return page.evaluate(() => location.href);
}

/** One value of the link that the address holds. */
export async function inLink(page: Page, key: string): Promise<string | null> {
    return new URLSearchParams(new URL(await addressOf(page)).hash.slice(1)).get(key);
}

export interface Place {
    x: number;
    y: number;
}

type Shown = {tetralight: {viewer: {stage: {drawNow(): void; canvas: HTMLCanvasElement;
    pageFrom(v: unknown): Place}}; inspect: {object: {ball: {position: unknown}}}}};

/** Where the ball is in the page. */
export function ballPlace(page: Page): Promise<Place> {
    return page.evaluate(() => {
        const {viewer, inspect} = (window as unknown as Shown).tetralight;
        return viewer.stage.pageFrom(inspect.object.ball.position);
    });
}

export async function canvasMiddle(page: Page): Promise<Place> {
    const {x, y, width, height} = (await page.locator('#view canvas').boundingBox())!;
    return {x: x + width / 2, y: y + height / 2};
}

/** As by hand: text that is no number, too, and then away. */
export async function typeInto(field: Locator, text: string): Promise<void> {
    await field.fill('');
    await field.pressSequentially(text);
    await field.press('Tab');
}

/** The median colour, 0 to 255, of 7 × 7 pixels of the canvas around a place of the page: no thin line. */
export function colorAt(page: Page, place: Place): Promise<number[]> {
    return page.evaluate(({x, y}) => {
        const {stage} = (window as unknown as Shown).tetralight.viewer;
        stage.drawNow();  // in this task the canvas still has its picture
        const box = stage.canvas.getBoundingClientRect();
        const scale = stage.canvas.width / box.width;
        const copy = document.createElement('canvas');
        copy.width = copy.height = 7;
        const context = copy.getContext('2d')!;
        context.drawImage(stage.canvas, (x - box.left) * scale - 3, (y - box.top) * scale - 3, 7, 7, 0, 0, 7, 7);
        const {data} = context.getImageData(0, 0, 7, 7);
        return [0, 1, 2].map(c => [...data].filter((_, i) => i % 4 === c).sort((a, b) => a - b)[24]);
    }, place);
}
