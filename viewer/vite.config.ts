// SPDX-License-Identifier: Apache-2.0
import {readFileSync, readdirSync, writeFileSync} from 'node:fs';
import {join, resolve} from 'node:path';
import {fileURLToPath} from 'node:url';
import {gzipSync} from 'node:zlib';
import type {Plugin} from 'vite';
import {defineConfig} from 'vitest/config';

/** Writes NAME.gz beside each file of the page; the server sends it to clients that accept gzip. */
function compress(): Plugin {
    let folder = '';
    return {
        name: 'compress',
        apply: 'build',
        configResolved(config) { folder = resolve(config.root, config.build.outDir); },
        closeBundle() {
            for (const name of readdirSync(folder, {recursive: true}) as string[]) {
                if (!/\.(html|js|css|svg|json|wasm)$/.test(name)) continue;
                const path = join(folder, name);
                writeFileSync(`${path}.gz`, gzipSync(readFileSync(path), {level: 9}));
            }
        },
    };
}

/** Comments and indents of shaders stay out of the page. */
function shortenShaders(): Plugin {
    return {
        name: 'shorten shaders',
        apply: 'build',
        enforce: 'pre',
        load(id) {
            if (!id.endsWith('.glsl?raw')) return null;
            const shader = readFileSync(id.slice(0, -'?raw'.length), 'utf8');
            const lines = shader.split('\n').map(line => line.replace(/\/\/.*/, '').trim()).filter(line => line !== '');
            return `export default ${JSON.stringify(lines.map(line => line + '\n').join(''))}`;
        },
    };
}

const kPackage = fileURLToPath(new URL('../packages/js/src', import.meta.url));

export default defineConfig({
    plugins: [shortenShaders(), compress()],
    resolve: {
        alias: [{find: /^tetralight$/, replacement: `${kPackage}/index.ts`},
                {find: /^tetralight\/three$/, replacement: `${kPackage}/three/index.ts`}],
        dedupe: ['three'],  // of viewer/node_modules
    },
    build: {
        outDir: '../build/viewer',
        emptyOutDir: true,
        target: 'es2022',
        minify: 'terser',  // its files are 3 % smaller than esbuild's
        terserOptions: {compress: {passes: 2}},
        assetsInlineLimit: 0,  // the server's policy allows files of its own only
        modulePreload: {polyfill: false},
        chunkSizeWarningLimit: 1500,
    },
    server: {fs: {allow: ['..']}, proxy: {'/v1': 'http://127.0.0.1:8080'}},
    test: {include: ['tests/**/*.test.ts']},
});
