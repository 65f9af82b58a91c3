// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {ApiError, messageOf} from '../../src/page/api';
import {ErrorWithWayOn, explainScene, openOrExplain} from '../../src/page/gone';

const way = {text: 'Open the newest', go: () => {}};
const fails = (error: Error) => () => Promise.reject(error);

test('what the server does not have is explained, with a way on', async () => {
    const missing = fails(new ApiError(404, 'not_found', 'there is no volume'));
    const error = await openOrExplain('volume', 'hall', missing, way).catch((e: unknown) => e);
    expect(error).toBeInstanceOf(ErrorWithWayOn);
    expect((error as ErrorWithWayOn).message).toContain('The volume "hall" is not on this server any more');
    expect((error as ErrorWithWayOn).way).toBe(way);
});

test('ids are shortened', async () => {
    const missing = fails(new ApiError(404, 'not_found', 'there is no scene'));
    const error = await openOrExplain('scene', 'a'.repeat(64), missing, way).catch((e: unknown) => e);
    expect((error as ErrorWithWayOn).message).toContain('"aaaaaaaa"');
});

test('other errors stay what they are', async () => {
    const damaged = new ApiError(422, 'damaged', 'the volume is damaged');
    await expect(openOrExplain('volume', 'hall', fails(damaged), way)).rejects.toBe(damaged);
});

test('a volume is shown without a scene that is gone', () => {
    const missing = new ApiError(404, 'not_found', 'there is no scene', 'scene');
    expect(messageOf(explainScene(missing, 'hall'))).toMatch(/^The scene of hall was deleted: .* without it\. Upload/);
    const refused = new ApiError(400, 'invalid', 'samples: 0 is too small', 'samples');
    expect(explainScene(refused, 'hall')).toBe(refused);
});
