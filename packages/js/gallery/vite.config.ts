// SPDX-License-Identifier: Apache-2.0
// The folder `input` is served beside the page. filament.js finds filament.wasm beside itself, so both keep their names.
import {createReadStream, readFileSync} from 'node:fs';
import {join} from 'node:path';
import {fileURLToPath} from 'node:url';

import {defineConfig, Plugin} from 'vite';

const kFilament = fileURLToPath(new URL('../node_modules/filament', import.meta.url));
const kFiles = ['filament.js', 'filament.wasm'];

const filament: Plugin = {
    name: 'filament',
    configureServer(server) {
        for (const name of kFiles) {
            server.middlewares.use(`/filament/${name}`, (_, response) => {
                response.setHeader('Content-Type', name.endsWith('.js') ? 'text/javascript' : 'application/wasm');
                createReadStream(join(kFilament, name)).pipe(response);
            });
        }
    },
    generateBundle() {
        for (const name of kFiles) {
            this.emitFile({type: 'asset', fileName: `filament/${name}`, source: readFileSync(join(kFilament, name))});
        }
    },
};

export default defineConfig({base: './', publicDir: 'input', plugins: [filament],
                             build: {target: 'es2022', chunkSizeWarningLimit: 8000}});
