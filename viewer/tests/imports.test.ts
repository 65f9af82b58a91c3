// SPDX-License-Identifier: Apache-2.0
import {readdirSync, readFileSync} from 'node:fs';
import {fileURLToPath} from 'node:url';
import {expect, test} from 'vitest';

const kSources = fileURLToPath(new URL('../src', import.meta.url));

/** Each folder imports from itself and from the folders before it; the tabs do not import from each other. */
const kFolders = ['page', 'light', 'scene', 'view'];
const kTabs = ['inspect', 'compare', 'edit', 'bake'];

function importsOf(folder: string): string[] {
    return readdirSync(`${kSources}/${folder}`).flatMap(file => {
        const text = readFileSync(`${kSources}/${folder}/${file}`, 'utf8');
        return [...text.matchAll(/from '\.\.\/(\w+)\//g)].map(([, other]) => other);
    });
}

test.each([...kFolders, ...kTabs])('%s imports only from the folders below it', folder => {
    const at = kFolders.indexOf(folder);
    const lower = at < 0 ? kFolders : kFolders.slice(0, at);
    expect(importsOf(folder).filter(other => !lower.includes(other))).toEqual([]);
});
