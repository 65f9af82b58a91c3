// SPDX-License-Identifier: Apache-2.0
// The examples import the sources of the package beside them, as programs import the package.
import {fileURLToPath} from 'node:url';

import {defineConfig} from 'vite';

const at = (path: string) => fileURLToPath(new URL(path, import.meta.url));

export default defineConfig({
    root: at('.'),
    resolve: {alias: [
        {find: /^tetralight$/, replacement: at('../src/index.ts')},
        {find: /^tetralight\/three$/, replacement: at('../src/three/index.ts')},
    ]},
    build: {target: 'es2022', rollupOptions: {input: ['character', 'balls', 'day'].map(name => at(`${name}.html`))}},
});
