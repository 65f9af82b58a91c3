// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {LatePart} from '../../src/page/late_part';

test('a part is made once, when it is first used', async () => {
    let count = 0;
    const part = new LatePart(async () => ++count);
    await part.settled();
    expect([count, part.value]).toEqual([0, null]);
    expect(await Promise.all([part.get(), part.get()])).toEqual([1, 1]);
    expect(part.value).toBe(1);
});

test('a part that could not be fetched is fetched again', async () => {
    let isLost = true;
    const part = new LatePart(async () => {
        if (isLost) throw new Error('no connection');
        return 'here';
    });
    await expect(part.get()).rejects.toThrow('no connection');
    await part.settled();
    expect(part.value).toBe(null);
    isLost = false;
    expect(await part.get()).toBe('here');
});
