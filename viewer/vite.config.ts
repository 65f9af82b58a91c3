// SPDX-License-Identifier: Apache-2.0
import {defineConfig} from 'vitest/config';

export default defineConfig({
    build: {
        outDir: '../build/viewer',
        emptyOutDir: true,
        target: 'es2022',
        assetsInlineLimit: 0,  // the server's policy allows files of its own only
        modulePreload: {polyfill: false},
        chunkSizeWarningLimit: 1500,
    },
    server: {fs: {allow: ['..']}, proxy: {'/v1': 'http://127.0.0.1:8080'}},
    test: {include: ['tests/**/*.test.ts']},
});
