// SPDX-License-Identifier: Apache-2.0
import {afterEach, expect, test, vi} from 'vitest';
import {Api, type Bake} from '../../src/page/api';

/** A body that comes in these pieces. */
function bodyOf(pieces: string[]): ReadableStream<Uint8Array> {
    const encoder = new TextEncoder();
    return new ReadableStream({
        start(controller) {
            for (const piece of pieces) controller.enqueue(encoder.encode(piece));
            controller.close();
        },
    });
}

function makeApi(pieces: string[]) {
    const asked: string[] = [];
    vi.stubGlobal('sessionStorage', {getItem: () => ''});
    vi.stubGlobal('fetch', async (path: string) => {
        asked.push(path);
        return new Response(bodyOf(pieces));
    });
    return {asked, api: new Api({lost() {}, found() {}, unauthorized() {}})};
}

afterEach(() => vi.unstubAllGlobals());

test('one request follows many bakes', async () => {
    const ids = Array.from({length: 20}, (_, i) => `bake${i}`);
    const events = ids.map(id => `event: progress\ndata: ${JSON.stringify({id, state: 'running'})}\n\n`);
    const {asked, api} = makeApi(events);
    const shown: Bake[] = [];
    await api.watchBakes(bake => shown.push(bake), new AbortController().signal);
    expect(asked).toEqual(['/v1/bakes/events']);
    expect(shown.map(({id}) => id)).toEqual(ids);
});

test('events that come in pieces are read whole, and silence is no event', async () => {
    const text = ':\n\nevent: end\ndata: {"id":"a","state":"deleted"}\n\n';
    const {api} = makeApi([...text]);
    const shown: Bake[] = [];
    await api.watchBakes(bake => shown.push(bake), new AbortController().signal);
    expect(shown).toEqual([{id: 'a', state: 'deleted'}]);
});
