// SPDX-License-Identifier: Apache-2.0
// `lightmap.threejs` of `./run bench lightmap`: the courtyard with lightmaps in three.js against the
// pictures of `tetralight render`, in steps of 255. One JSON object a line, as the other benchmarks print them.
import {existsSync} from 'node:fs';

import {close, kChromium} from '../browser_tests/browser';
import {LightmapPictures, quantile} from '../browser_tests/lightmap_pictures';

const kCameras = ['camera', 'camera_interior'];
const kSize = {width: 960, height: 540};

async function differences(pictures: LightmapPictures, light: 'halves' | 'rgbm'): Promise<void> {
    const sum = new Array<number>(256).fill(0);
    for (const camera of kCameras) {
        const shown = await pictures.show(light, camera, kSize);
        const counts = await pictures.differences(shown, camera, kSize);
        counts.forEach((count, step) => { sum[step] += count; });
    }
    console.log(JSON.stringify({
        figure: `lightmap.threejs.${light}`, ours: quantile(sum, 0.99), unit: 'of 255, p99',
        p999: quantile(sum, 0.999), worst: quantile(sum, 1), pixels: sum.reduce((all, count) => all + count),
    }));
}

async function main(): Promise<void> {
    if (!existsSync(kChromium)) {
        console.error(`skipped: lightmap.threejs needs Chromium, and there is no ${kChromium}`);
        return;
    }
    const pictures = new LightmapPictures();
    try {
        await pictures.start({texelsPerMeter: 10, samples: 64, pageSize: 1024});
        await differences(pictures, 'halves');
        await differences(pictures, 'rgbm');
    } finally {
        await close();
        pictures.end();
    }
}

await main();
