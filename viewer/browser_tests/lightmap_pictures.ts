// SPDX-License-Identifier: Apache-2.0
// The courtyard with lightmaps, in three.js and by `tetralight render`. For tests and benchmarks.
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import type {JSHandle, Page} from 'playwright-core';

import {newContext} from './browser';
import {FileServer} from './files';
import {kCourtyard, run} from './server';

/** What `lightmap_picture.js` has in the page. */
export interface LightmapPicture {
    lights: string[];
    exposure(): number;
    radiance(): Float32Array;
    differences(exposure: number, url: string): Promise<number[]>;
    shift(distance: number): void;
    textures(): number;
}

/** Sets the mode of all lights to baked: lightmaps then hold all light, and no renderer adds any. */
function withBakedLights(glb: Buffer): Buffer {
    const kHeader = 20;
    const length = glb.readUInt32LE(12);
    const json = JSON.parse(glb.toString('utf8', kHeader, kHeader + length));
    for (const light of json.extensions.KHR_lights_punctual.lights) light.extras = {...light.extras, mode: 'baked'};
    const text = Buffer.from(JSON.stringify(json));
    const padded = Buffer.concat([text, Buffer.alloc(-text.length & 3, ' ')]);
    const made = Buffer.concat([glb.subarray(0, kHeader), padded, glb.subarray(kHeader + length)]);
    made.writeUInt32LE(made.length, 8);
    made.writeUInt32LE(padded.length, 12);
    return made;
}

interface Bake {
    texelsPerMeter: number;
    samples: number;
    pageSize: number;
}

interface View {
    scene?: string;
    width?: number;
    height?: number;
}

export class LightmapPictures {
    readonly folder = mkdtempSync(join(tmpdir(), 'tetralight_lightmaps_'));
    private readonly files = new FileServer(this.folder);
    private page: Page | null = null;

    /** Bakes the courtyard and exports it. */
    async start({texelsPerMeter, samples, pageSize}: Bake): Promise<this> {
        const [scene, lightmaps] = [this.path('court.glb'), this.path('court.lightmaps')];
        writeFileSync(scene, withBakedLights(readFileSync(kCourtyard)));
        run('lightmap', scene, '-o', lightmaps, '--texels-per-meter', `${texelsPerMeter}`,
            '--samples', `${samples}`, '--page-size', `${pageSize}`);
        run('bake', scene, '-o', this.path('court.probes'), '--samples', '16');
        run('export', lightmaps, '--scene', scene, '-o', this.path('lit.glb'));
        run('export', lightmaps, '-o', this.path('lit.ktx2'));
        await this.files.start();
        return this;
    }

    end(): void {
        this.files.end();
        rmSync(this.folder, {recursive: true, force: true});
    }

    path(name: string): string {
        return join(this.folder, name);
    }

    /** The address of examples/threejs with files of the folder. */
    example(files: Record<string, string>): string {
        const query = Object.entries(files).map(([key, name]) => `${key}=/made/${name}`).join('&');
        return `${this.files.url}/examples/threejs/index.html?${query}`;
    }

    /** The scene in a page of Chromium, with the light of one of the exported files. */
    async show(light: 'rgbm' | 'halves', camera: string,
               {scene = 'lit.glb', width = 480, height = 270}: View = {}): Promise<JSHandle<LightmapPicture>> {
        await this.page?.context().close();
        this.page = await (await newContext()).newPage();
        await this.page.goto(this.example({}));  // for its import map
        const halves = light === 'halves' ? '/made/lit.ktx2' : null;
        const settings = JSON.stringify({scene: `/made/${scene}`, halves, camera, width, height});
        return this.page.evaluateHandle<LightmapPicture>(
            `import('/viewer/browser_tests/lightmap_picture.js').then(made => made.LightmapPicture.open(${settings}))`);
    }

    /** Pixels of `tetralight render` by how far they are from those in the page, 0 to 255. */
    async differences(picture: JSHandle<LightmapPicture>, camera: string,
                      {width = 480, height = 270}: View = {}): Promise<number[]> {
        const exposure = await picture.evaluate(shown => shown.exposure());
        run('render', this.path('court.glb'), this.path('court.probes'), '--lightmaps', this.path('court.lightmaps'),
            '-o', this.path('ours.png'), '--camera', camera, '--exposure', `${exposure}`,
            '--width', `${width}`, '--height', `${height}`, '--antialias', '1');
        return picture.evaluate((shown, factor) => shown.differences(factor, '/made/ours.png'), exposure);
    }
}

/** The smallest difference that this share of the pixels does not exceed. */
export function quantile(counts: number[], share: number): number {
    const total = counts.reduce((sum, count) => sum + count, 0);
    let below = 0;
    return counts.findIndex(count => (below += count) >= share * total);
}
