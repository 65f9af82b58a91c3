// SPDX-License-Identifier: Apache-2.0
// Time of a frame at 960 × 540 with 100 000 probe-lit balls of 12 triangles over that of the same without probes. Prints a
// JSON object a line: 1 000 balls move, then all. The light of a few balls is checked by browser_tests/three.test.ts.
import {kCanRun} from '../browser_tests/open_page.js';
import {LitSquares, TestPage} from '../browser_tests/three_browser.js';
import type {page as PageOfBrowser} from './three_frame_page.js';

const kCount = 100_000;
const kFrames = 9;

const median = (times: readonly number[]) => [...times].sort((a, b) => a - b)[Math.floor(times.length / 2)];
const round = (x: number) => Math.round(1000 * x) / 1000;

if (!kCanRun) throw new Error('set TETRALIGHT_COMMAND and TETRALIGHT_COURTYARD, and install Chromium');
const lit = new LitSquares();
const opened = await TestPage.open('../bench/three_frame_page.ts');
for (const moving of [1000, kCount]) {
    const times = await opened.page.evaluate(([bytes, count, moved, frames]) => {
        const {page} = window as unknown as {page: typeof PageOfBrowser};
        return page.run(bytes, [-3.5, 0.2, -2.5], [3.5, 3, 2.5], count, moved, frames);
    }, [lit.base64, kCount, moving, kFrames] as const);
    const [ours, baseline, update] = [times.lit, times.plain, times.update].map(median);
    console.log(JSON.stringify({
        figure: `three.frame.${moving === kCount ? 'all_moving' : 'moving_1000'}`, ours: round(ours),
        baseline: round(baseline), unit: 'ms', ratio: round(ours / baseline), update_ms: round(update),
        baseline_is: 'the same balls, moved in the same way, without probes',
    }));
}
await opened.close();
