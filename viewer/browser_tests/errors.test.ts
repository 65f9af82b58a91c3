// SPDX-License-Identifier: Apache-2.0
// What goes wrong is said in words, and the page goes on.
import {readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';

import {afterAll, beforeAll, expect, test} from 'vitest';

import {readGlbJson, withGlbJson} from '../src/scene/glb';
import {close, ready} from './browser';
import {kCourtyard, Server} from './server';
import {visit} from './visit';

let server: Server;
let volume: string;

beforeAll(async () => {
    server = await new Server().start();
    volume = await server.bake({scene: await server.uploadCourtyard(), samples: 32, name: 'court'});
});
afterAll(async () => {
    await close();
    await server?.end();
});

test('a killed server is noticed, and the page recovers when it is back', () => visit(server.url, async page => {
    await ready(page);
    const height = page.getByLabel('Position of the ball, metres y');
    await page.click('#tab-inspect');
    await server.kill();
    await page.getByText('The server does not answer').waitFor();
    // Queries need no server.
    await page.locator('.answer h3').evaluate(heading => { heading.textContent = 'of before'; });
    await height.fill('3');
    await height.press('Tab');
    await page.locator('.answer h3', {hasText: /^(Hull c|C)ell \d+$/}).waitFor();
    await server.start();
    await page.locator('#banner').waitFor({state: 'hidden'});
    await page.locator('#status', {hasText: 'courtyard · court: 255 probes'}).waitFor();
}, {refusal: /ERR_CONNECTION_REFUSED|ERR_CONNECTION_RESET|ERR_EMPTY_RESPONSE/}));

test('a server that dies while nobody asks it is noticed, and an edit of meanwhile is joined', () => visit(
    server.url + '/#tab=edit', async page => {
        await ready(page);
        const facts = page.locator('#panel-edit .facts').first();
        await page.getByText(/^255 probes .+ joined by/).waitFor();
        await server.kill();
        await page.getByText('The server does not answer').waitFor();
        await page.getByRole('button', {name: 'Add probe'}).click();
        expect(await facts.textContent()).toBe('256 probes in 5 groups');
        await server.start();
        await page.locator('#banner').waitFor({state: 'hidden'});
        await page.getByText(/^256 probes .+ joined by/).waitFor();
    }, {refusal: /ERR_CONNECTION_REFUSED|ERR_CONNECTION_RESET|ERR_EMPTY_RESPONSE/}));

test('what was missing is forgiven when one goes on', () => visit(server.url + '/#tab=bake', async page => {
    await ready(page);
    await page.locator('#choose').getByLabel('Scene').selectOption('');
    await page.getByRole('button', {name: 'Bake', exact: true}).click();
    await page.locator('#banner', {hasText: 'Open a scene first'}).waitFor();
    await page.getByRole('tab', {name: 'View'}).click();
    expect(await page.locator('#banner').isHidden()).toBe(true);
}));

test('a corrupt volume is refused in words, and the shown one stays', () => visit(server.url, async page => {
    await ready(page);
    const answer = await fetch(`${server.url}/v1/volumes/${volume}/file`);
    const bytes = new Uint8Array(await answer.arrayBuffer());
    bytes[bytes.length >> 1] ^= 0xff;
    const path = join(server.folder, 'broken.probes');
    writeFileSync(path, bytes);
    await page.locator('header input[type=file]').setInputFiles(path);
    await page.locator('#banner', {hasText: 'broken.probes'}).waitFor();
    expect(await page.textContent('#banner')).toMatch(/checksum|corrupt|damaged/);
    await page.locator('#status', {hasText: 'court: 255 probes'}).waitFor();
}, {refusal: /status of 422/}));

test('a volume that is damaged on the disk is told of when it is chosen, and the shown one stays', () => visit(
    server.url, async page => {
        await ready(page);
        const groups = await server.request<{id: string}>('POST', '/v1/groups', JSON.stringify(
            {groups: [{name: 'few', positions: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]}]}));
        const {id} = await server.request<{id: string}>(
            'POST', '/v1/tetrahedralize', JSON.stringify({groups: [groups.id], name: 'torn'}));
        await page.reload();
        await ready(page);
        await page.getByLabel('Probe volume').selectOption(volume);
        await page.locator('#status', {hasText: 'court: 255 probes'}).waitFor();
        const path = join(server.folder, 'data', 'volumes', `${id}.probes`);
        const bytes = readFileSync(path);
        bytes[bytes.length >> 1] ^= 0xff;
        writeFileSync(path, bytes);
        await page.getByLabel('Probe volume').selectOption(id);
        await page.locator('#banner', {hasText: /damaged|corrupt/}).waitFor();
        await page.waitForTimeout(1000);
        expect(await page.locator('#banner').isVisible()).toBe(true);
        await page.locator('#status', {hasText: 'court: 255 probes'}).waitFor();
        await server.request('DELETE', `/v1/volumes/${id}`);
    }, {refusal: /status of 4\d\d/}));

test('wrong settings are refused in the server’s words', () => visit(server.url + '/#tab=bake', async page => {
    await ready(page);
    for (const preset of ['production', 'custom']) await page.getByLabel('Preset').selectOption(preset);
    await page.getByLabel('Bounces', {exact: true}).fill('-1');
    await page.getByRole('button', {name: 'Bake', exact: true}).click();
    await page.locator('#banner', {hasText: /^Bounces: /}).waitFor();
    const bounces = page.getByLabel('Bounces', {exact: true});
    expect(await bounces.getAttribute('aria-invalid')).toBe('true');
    expect(await bounces.evaluate(field => field === document.activeElement)).toBe(true);
    expect(await page.getByLabel('Name of the volume').inputValue()).toBe('courtyard');
    await bounces.fill('0');
    await page.getByLabel('Samples', {exact: true}).fill('32');
    await page.getByRole('button', {name: 'Bake', exact: true}).click();
    await page.locator('#banner').waitFor({state: 'hidden'});
}, {refusal: /status of 400/}));

/** The courtyard without its probe groups, as another scene. */
function bareCourtyard(): ArrayBuffer {
    const file = readFileSync(kCourtyard);
    const glb = file.buffer.slice(file.byteOffset, file.byteOffset + file.byteLength) as ArrayBuffer;
    const json = readGlbJson(glb);
    for (const node of json.nodes!) {
        if (node.extras?.light_probe_group !== true) continue;
        delete node.extras;
        delete node.mesh;
    }
    return withGlbJson(glb, json);
}

test('a scene that is chosen is in its own light, and one without probe groups is led to the tab Edit', async () => {
    const {id} = await server.request<{id: string}>('POST', '/v1/scenes?name=bare', bareCourtyard());
    await visit(server.url, async page => {
        await ready(page);
        await page.locator('#choose').getByLabel('Scene').selectOption('');
        await page.locator('#choose').getByLabel('Scene').selectOption(id);
        await page.locator('#status', {hasText: /^court.* is closed: it is of another scene\.$/}).waitFor();
        expect(await page.getByLabel('Probe volume').inputValue()).toBe('');
        await page.getByRole('tab', {name: 'Bake'}).click();
        await page.getByText('This scene has no probe groups').waitFor();
        await page.getByRole('button', {name: 'Bake', exact: true}).click();
        await page.locator('#banner', {hasText: 'The scene has no probe groups'}).waitFor();
        await page.getByRole('button', {name: 'Open Edit'}).click();
        await page.getByRole('heading', {name: 'Generate'}).waitFor();
        expect(await page.locator('#banner').isHidden()).toBe(true);
        await page.locator('#choose').getByLabel('Scene').selectOption({label: 'courtyard'});
        await page.locator('#status', {hasText: /^courtyard · court.*: 255 probes$/}).waitFor();
    });
    await server.request('DELETE', `/v1/scenes/${id}`);
});

test('what was deleted meanwhile is named by its name, and is not in the list any more', () => visit(server.url, async page => {
    const {id} = await server.request<{id: string}>('POST', '/v1/scenes?name=passing', bareCourtyard());
    await ready(page);
    await page.reload();
    await ready(page);
    await server.request('DELETE', `/v1/scenes/${id}`);
    await page.locator('#choose').getByLabel('Scene').selectOption(id);
    await page.locator('#banner', {hasText: 'there is no such scene: passing (it was deleted)'}).waitFor();
    await expect.poll(() => page.locator('#choose option', {hasText: 'passing'}).count()).toBe(0);
}, {refusal: /status of 404/}));

test('an order that the server did not answer is told of until someone has read it', () => visit(server.url + '/#tab=bake', async page => {
    await ready(page);
    await page.getByLabel('What to bake').waitFor();
    await server.kill();
    await page.getByRole('button', {name: 'Bake', exact: true}).click();
    const words = page.getByText('The server did not answer the order of a bake');
    await words.waitFor();
    await server.start();
    await page.getByText('The server answers again.').waitFor();
    expect(await words.isVisible()).toBe(true);
    await page.getByRole('button', {name: 'Close', exact: true}).click();
    expect(await page.locator('#banner').isHidden()).toBe(true);
}, {refusal: /ERR_CONNECTION_REFUSED|ERR_CONNECTION_RESET|ERR_EMPTY_RESPONSE|ERR_INCOMPLETE_CHUNKED/}));

test('an empty server says what to do', async () => {
    const other = await new Server().start();
    await visit(other.url, async page => {
        await ready(page);
        expect(await page.textContent('.empty')).toContain('Upload a scene');
        expect(await page.locator('#panel-inspect input[type=checkbox]:disabled').count()).toBe(2);
        await page.getByRole('tab', {name: 'Edit'}).click();
        for (const name of ['Take those of the volume', 'Open', 'Select all', 'Duplicate', 'Delete']) {
            expect(await page.getByRole('button', {name, exact: true}).isDisabled(), name).toBe(true);
        }
        await page.locator('header input[type=file]').setInputFiles(kCourtyard);
        await page.getByText('No volume yet').waitFor();
        await page.getByRole('button', {name: 'bake one'}).click();
        expect(await page.getByRole('tab', {name: 'Bake'}).getAttribute('aria-selected')).toBe('true');
    });
    await other.end();
});

test('a server with a token asks for it, and says that a wrong one is wrong', async () => {
    const other = await new Server('a-secret-of-20-chars').start();
    await visit(other.url, async page => {
        await page.getByLabel('Token', {exact: true}).fill('wrong');
        await page.getByRole('button', {name: 'Enter'}).click();
        await page.getByText('The token is wrong.').waitFor();
        await page.getByLabel('Token', {exact: true}).fill('a-secret-of-20-chars');
        await page.getByRole('button', {name: 'Enter'}).click();
        await page.locator('.empty').waitFor();
        expect(await page.locator('dialog[open]').count()).toBe(0);
    }, {refusal: /status of 401/});
    await other.end();
});
