// SPDX-License-Identifier: Apache-2.0
// The last step of `./run demo`: a data folder with the courtyard, for `tetralight serve`, and a picture
// of the page that shows it. Arguments: the folder, the picture.
import {close, drawn, open} from './browser_tests/browser';
import {Server} from './browser_tests/server';

const [folder, picture] = process.argv.slice(2);
const server = await new Server('', folder).start();
try {
    const scene = await server.uploadCourtyard();
    await server.bake({scene, name: 'courtyard', samples: 1024, layers: ['sun', 'sky', 'emission']});
    const view = '/#tab=inspect&object=2.6,1.3,6';
    const page = await open(server.url + view, {width: 1200, height: 720});
    await page.getByText(/cell \d+$/i).waitFor();
    await drawn(page);
    await page.screenshot({path: picture});
} finally {
    await close();
    await server.kill();
}
