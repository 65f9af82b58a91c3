// SPDX-License-Identifier: Apache-2.0
// What users install.
import {execFileSync} from 'node:child_process';
import {mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {dirname, join} from 'node:path';
import {gzipSync} from 'node:zlib';

import {build, Rollup, transformWithEsbuild} from 'vite';
import {afterAll, beforeAll, describe, expect, test} from 'vitest';

const kRoot = join(__dirname, '..');

test('the bundle of the core has at most 30 kB gzipped, and no code of engines', async () => {
    const built = await build({
        root: kRoot, configFile: false, logLevel: 'error',
        build: {write: false, target: 'es2022', lib: {entry: join(kRoot, 'src/index.ts'), formats: ['es'], fileName: 'index'}},
    }) as Rollup.RollupOutput[];
    const chunks = built[0].output;
    expect(chunks).toHaveLength(1);
    expect((chunks[0] as Rollup.OutputChunk).moduleIds.filter(name => !name.startsWith(join(kRoot, 'src')))).toEqual([]);
    // Vite keeps the blanks of libraries.
    const {code} = await transformWithEsbuild((chunks[0] as Rollup.OutputChunk).code, 'index.js', {minify: true});
    expect(gzipSync(code, {level: 9}).length).toBeLessThanOrEqual(30_000);
});

test('the package has no dependencies and runs nothing when it is installed', () => {
    const json = JSON.parse(readFileSync(join(kRoot, 'package.json'), 'utf8')) as Record<string, Record<string, string>>;
    expect(json.dependencies ?? {}).toEqual({});
    expect(Object.keys(json.scripts).filter(name => /install|prepare|postpack/.test(name))).toEqual([]);
});

describe('the packed package, installed into an empty project', () => {
    const folder = mkdtempSync(join(tmpdir(), 'tetralight-'));
    const run = (command: string, args: string[], cwd: string) => execFileSync(command, args, {cwd, encoding: 'utf8'});
    beforeAll(() => {
        const packed = run('npm', ['pack', '--silent', '--pack-destination', folder], kRoot).trim().split('\n').pop() ?? '';
        writeFileSync(join(folder, 'package.json'), '{"name": "game", "private": true, "type": "module"}');
        run('npm', ['install', '--offline', '--no-audit', '--no-fund', '--silent', `./${packed}`], folder);
    });
    afterAll(() => rmSync(folder, {recursive: true, force: true}));

    test('has the files that it needs alone', () => {
        const files = readdirSync(join(folder, 'node_modules/tetralight')).sort();
        expect(files).toEqual(['LICENSE', 'README.md', 'dist', 'package.json']);
        expect(readdirSync(join(folder, 'node_modules')).filter(name => !name.startsWith('.'))).toEqual(['tetralight']);
    });

    test('imports engines by the entries that are named after them alone', () => {
        const dist = join(folder, 'node_modules/tetralight/dist');
        const names = readdirSync(dist, {recursive: true, encoding: 'utf8'}).filter(name => name.endsWith('.js'));
        const imports = names.flatMap(name => {
            const code = readFileSync(join(dist, name), 'utf8');
            return [...code.matchAll(/ from ['"]([^.'"][^'"]*)['"]/g)].map(([, from]) => `${dirname(name)}: ${from}`);
        });
        expect(imports).toContain('three: three');
        expect(imports.filter(each => !/^(three: three|babylon: @babylonjs\/core)(\/|$)/.test(each))).toEqual([]);
        expect(names).toEqual(expect.arrayContaining(['playcanvas/index.js', 'filament/index.js', 'babylon/index.js']));
        expect(names.filter(name => /gallery|test/.test(name))).toEqual([]);
    });

    test('is imported by Node', () => {
        writeFileSync(join(folder, 'names.js'), "import * as all from 'tetralight'; console.log(Object.keys(all).join());");
        expect(run(process.execPath, ['names.js'], folder).trim().split(',')).toContain('read');
    });

    test('is bundled by Vite, without what the page does not use', async () => {
        writeFileSync(join(folder, 'main.js'), "import {irradiance} from 'tetralight'; console.log(irradiance([], [0, 1, 0]));");
        writeFileSync(join(folder, 'index.html'), '<script type="module" src="main.js"></script>');
        const built = await build({root: folder, configFile: false, logLevel: 'error', build: {write: false}});
        const [chunk] = (built as Rollup.RollupOutput).output;
        expect(chunk.type).toBe('chunk');
        expect((chunk as Rollup.OutputChunk).code.length).toBeLessThan(3000);
    });
});
