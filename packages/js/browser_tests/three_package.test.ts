// SPDX-License-Identifier: Apache-2.0
// The packed package beside three.js, in a project of Vite.
import {execFileSync} from 'node:child_process';
import {mkdtempSync, rmSync, symlinkSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';

import {build, Rollup} from 'vite';
import {afterAll, beforeAll, expect, test} from 'vitest';

const kRoot = join(__dirname, '..');
const folder = mkdtempSync(join(tmpdir(), 'tetralight-'));

beforeAll(() => {
    const run = (args: string[], cwd: string) => execFileSync('npm', args, {cwd, encoding: 'utf8'});
    const packed = run(['pack', '--silent', '--pack-destination', folder], kRoot).trim().split('\n').pop() ?? '';
    writeFileSync(join(folder, 'package.json'), '{"name": "game", "private": true, "type": "module"}');
    run(['install', '--offline', '--no-audit', '--no-fund', '--silent', '--legacy-peer-deps', `./${packed}`], folder);
    symlinkSync(join(kRoot, 'node_modules/three'), join(folder, 'node_modules/three'));
});
afterAll(() => rmSync(folder, {recursive: true, force: true}));

/** The code of a page that runs a script. */
async function bundle(script: string): Promise<string> {
    writeFileSync(join(folder, 'main.js'), script);
    writeFileSync(join(folder, 'index.html'), '<script type="module" src="main.js"></script>');
    const built = await build({root: folder, configFile: false, logLevel: 'error', build: {write: false, target: 'es2022'},
                               resolve: {preserveSymlinks: true}});
    return ((built as Rollup.RollupOutput).output[0] as Rollup.OutputChunk).code;
}

test.each([
    ['tetralight/three', 'ProbeVolume'], ['tetralight/three/tsl', 'NodeProbeVolume'],
])('%s is bundled by Vite with what the page uses of it', async (entry, name) => {
    const code = await bundle(`import {read} from 'tetralight';
        import {${name}} from '${entry}';
        globalThis.probes = new ${name}(read(globalThis.file));`);
    const has = (text: string) => code.includes(text);
    expect([has('wrong first bytes'), has('IrradianceNode'), has('tetralightCubes')])
        .toEqual([true, entry.endsWith('tsl'), false]);  // the core; nodes; reflections, which it does not use
});
