// SPDX-License-Identifier: Apache-2.0
// `reflection.pmrem` of `./run bench reflection`: blurred levels of a cube against the sum over its
// texels, ours and those of three.js' PMREMGenerator in Chromium, each as its shader reads them.
// One JSON object a line, as the other benchmarks print them.
import {execFileSync} from 'node:child_process';
import {existsSync, mkdtempSync, readFileSync, readdirSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {basename, join} from 'node:path';
import type {Page} from 'playwright-core';

import {close, kChromium, newContext} from '../browser_tests/browser';
import {FileServer} from '../browser_tests/files';

type Light = number[][];

/** What `tetralight_bench reflection --pmrem` writes of a cube. */
interface Subject {
    size: number;
    directions: Light;
    lobes: {roughness: number; exact: Light; ours: Light}[];
}

/** The largest errors of cubes of which any filter must find the light: more, and their axes are mistaken. */
const kLargestErrors: Record<string, number> = {constant: 0.001, gradient: 0.02};

/** Root mean square of the difference, relative to the light. */
function errorOf(found: Light, exact: Light): number {
    let squares = 0, light = 0;
    exact.forEach((rgb, i) => rgb.forEach((value, c) => {
        squares += (found[i][c] - value) ** 2;
        light += value ** 2;
    }));
    return Math.sqrt(squares / light);
}

/** What three.js gets from the PMREM of the cube, for each roughness. */
async function pmremLight(page: Page, name: string, {size, directions, lobes}: Subject): Promise<Light[]> {
    const settings = {url: `/made/${name}.halves`, size, directions};
    const light = await page.evaluateHandle<{at(roughness: number): Light}>(
        `import('/viewer/bench/pmrem_light.js').then(made => made.PmremLight.open(${JSON.stringify(settings)}))`);
    return light.evaluate((shown, roughnesses) => roughnesses.map(roughness => shown.at(roughness)),
                          lobes.map(({roughness}) => roughness));
}

async function compare(page: Page, folder: string, name: string): Promise<void> {
    const subject: Subject = JSON.parse(readFileSync(join(folder, `${name}.json`), 'utf8'));
    const light = await pmremLight(page, name, subject);
    subject.lobes.forEach(({roughness, exact, ours}, i) => {
        const [error, baseline] = [errorOf(ours, exact), errorOf(light[i], exact)];
        if (name in kLargestErrors) {
            if (Math.max(error, baseline) > kLargestErrors[name])
                throw new Error(`${name}, roughness ${roughness}: errors of ${error} and, by three.js, ${baseline}`);
            return;
        }
        console.log(JSON.stringify({
            figure: `reflection.pmrem.${name}.${roughness}`, ours: Number((100 * error).toPrecision(4)), unit: '%',
            baseline: Number((100 * baseline).toPrecision(4)), ratio: Number((error / baseline).toPrecision(3)),
            baseline_is: 'the error of three.js\' PMREMGenerator',
        }));
    });
}

async function main(): Promise<void> {
    if (!existsSync(kChromium)) {
        console.error(`skipped: reflection.pmrem needs Chromium, and there is no ${kChromium}`);
        return;
    }
    const folder = mkdtempSync(join(tmpdir(), 'tetralight_pmrem_'));
    const files = await new FileServer(folder).start();
    try {
        const {TETRALIGHT_BENCH, INIT_CWD} = process.env;  // npm starts scripts in viewer/
        execFileSync(TETRALIGHT_BENCH!, ['reflection', '--pmrem', folder, ...process.argv.slice(2)],
                     {cwd: INIT_CWD, stdio: 'inherit'});
        const page = await (await newContext()).newPage();
        await page.goto(`${files.url}/examples/threejs/index.html`);  // for its import map
        const names = readdirSync(folder).filter(name => name.endsWith('.json')).map(name => basename(name, '.json'));
        for (const name of names) await compare(page, folder, name);
    } finally {
        await close();
        files.end();
        rmSync(folder, {recursive: true, force: true});
    }
}

await main();
