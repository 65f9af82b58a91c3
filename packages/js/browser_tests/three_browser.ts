// SPDX-License-Identifier: Apache-2.0
// Chromium with a bundled page, and the volume that the pages of three.js draw.
import {join} from 'node:path';

import type {Browser, Page} from 'playwright-core';

import {irradiance, read, Volume} from '../src/index.js';
import {Folder} from '../tests/command.js';
import {makePositions, makeRandom} from '../tests/random.js';
import {bundle, launch} from './open_page.js';
import type {Square} from './three_squares.js';

const kAlbedo = 0.5;
const kCount = 40;

/** A page with a script of this folder; problems of the page are listed in `problems`. */
export class TestPage {
    readonly problems: string[] = [];
    private constructor(private readonly browser: Browser, readonly page: Page) {}

    static async open(script: string): Promise<TestPage> {
        const code = await bundle(join(__dirname, script));
        const browser = await launch();
        const opened = new TestPage(browser, await (await browser.newContext()).newPage());
        opened.page.on('pageerror', error => opened.problems.push(error.message));
        opened.page.on('console', message => {
            const isOurs = !message.text().includes('GPU stall due to ReadPixels');
            if (isOurs && ['error', 'warning'].includes(message.type())) opened.problems.push(message.text());
        });
        await opened.page.addScriptTag({content: code});
        return opened;
    }

    async close(): Promise<void> {
        await this.browser.close();
    }
}

/** A volume with squares at places inside and around it. */
export class LitSquares {
    readonly folder = new Folder();
    readonly volume: Volume;
    /** The `.probes` file. */
    readonly base64: string;
    readonly squares: Square[];

    constructor() {
        const bytes = this.folder.bake(undefined, '--layers', 'sun,sky');
        this.volume = read(bytes);
        this.base64 = Buffer.from(bytes).toString('base64');
        const positions = makePositions(this.volume, 2 * kCount, 50);
        const random = makeRandom(51);
        this.squares = Array.from({length: kCount}, (_, i) => {
            const normal = [random() - 0.5, random() - 0.5, random() - 0.5];
            const length = Math.hypot(...normal);
            return {position: [...positions.subarray(6 * i + 3, 6 * i + 6)], normal: normal.map(x => x / length)};
        }).filter(({position}) => Math.hypot(...position) < 1000);
    }

    /** Radiance of a surface: albedo / π · E, and never negative. */
    radiance({position, normal}: Square): number[] {
        return irradiance(this.volume.light(position).sh, normal).map(value => kAlbedo / Math.PI * Math.max(value, 0));
    }

    get brightest(): number {
        return Math.max(...this.squares.flatMap(square => this.radiance(square)));
    }
}
