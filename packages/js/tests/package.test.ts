// SPDX-License-Identifier: Apache-2.0
// What users install.
import {execFileSync} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {pathToFileURL} from 'node:url';
import {gzipSync} from 'node:zlib';

import {build, Rollup, transformWithEsbuild} from 'vite';
import {expect, test} from 'vitest';

const kRoot = join(__dirname, '..');

test('the bundle of the core has at most 30 kB gzipped', async () => {
    const built = await build({
        root: kRoot, configFile: false, logLevel: 'error',
        build: {write: false, target: 'es2022', lib: {entry: join(kRoot, 'src/index.ts'), formats: ['es'], fileName: 'index'}},
    }) as Rollup.RollupOutput[];
    const chunks = built[0].output;
    expect(chunks).toHaveLength(1);
    // Vite keeps the blanks of libraries.
    const {code} = await transformWithEsbuild((chunks[0] as Rollup.OutputChunk).code, 'index.js', {minify: true});
    expect(gzipSync(code, {level: 9}).length).toBeLessThanOrEqual(30_000);
});

test('the package has no dependencies and runs nothing when it is installed', () => {
    const json = JSON.parse(readFileSync(join(kRoot, 'package.json'), 'utf8')) as Record<string, Record<string, string>>;
    expect(json.dependencies ?? {}).toEqual({});
    expect(Object.keys(json.scripts).filter(name => /install|prepare|postpack/.test(name))).toEqual([]);
});

test('Node imports the built package as it is', () => {
    const folder = mkdtempSync(join(tmpdir(), 'tetralight-'));
    try {
        const tsc = join(kRoot, 'node_modules/typescript/bin/tsc');
        execFileSync(process.execPath, [tsc, '--project', 'tsconfig.build.json', '--outDir', folder], {cwd: kRoot});
        const script = `import('${pathToFileURL(join(folder, 'index.js')).href}').then(m => console.log(Object.keys(m).join()))`;
        const names = execFileSync(process.execPath, ['--input-type=module', '--eval', script], {encoding: 'utf8'});
        expect(names.trim().split(',')).toContain('read');
    } finally {
        rmSync(folder, {recursive: true, force: true});
    }
});
