// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {formatGroups, Groups} from '../../src/edit/groups';
import {JoinedProbes} from '../../src/edit/joined_probes';

const kHall: Groups = [{name: 'hall', positions: [[0, 0, 0]]}];

/** A service that stores groups and volumes, but whose volumes cannot be read. */
function makeJoined() {
    const removed: string[] = [];
    const reported: unknown[] = [];
    let uploads = 0;
    const api = {
        upload: async () => ({file: {id: `g${++uploads}`}, isNew: true}),
        keep: async () => ({file: {id: 'v'}, isNew: true}),
        bytes: async () => new ArrayBuffer(8),
        remove: async (path: string) => { removed.push(path); },
    };
    const alerts = {report: (_: string, error: unknown) => { reported.push(error); }, succeed: () => {}};
    return {joined: new JoinedProbes(api as never, alerts as never), removed, reported, uploads: () => uploads};
}

const settled = () => new Promise(resolve => setTimeout(resolve, 10));

test('groups and volume are removed from the server once they are read', async () => {
    const {joined, removed, reported} = makeJoined();
    joined.ask(kHall);
    await settled();
    expect(removed).toEqual(['/v1/groups/g1', '/v1/volumes/v']);
    expect(String(reported[0])).toContain('the volume of these groups is damaged');
    expect(joined.tetrahedra).toBeNull();
});

test('groups that are saved stay on the server', async () => {
    const {joined, removed} = makeJoined();
    joined.leave(formatGroups(kHall));
    joined.ask(kHall);
    await settled();
    expect(removed).toEqual(['/v1/volumes/v']);
});

test('the same groups are joined once, and again after the server was lost', async () => {
    const {joined, uploads} = makeJoined();
    joined.ask(kHall);
    joined.ask(kHall);
    await settled();
    expect(uploads()).toBe(1);
    joined.askAgain();
    await settled();
    expect(uploads()).toBe(2);
});
