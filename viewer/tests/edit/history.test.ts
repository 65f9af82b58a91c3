// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {History} from '../../src/edit/history';

test('undo and redo walk through states, and an edit forgets what was undone', () => {
    const history = new History('a');
    history.become('b');
    history.become('c');
    history.undo();
    history.undo();
    expect([history.now, history.canUndo, history.canRedo]).toEqual(['a', false, true]);
    history.undo();
    history.redo();
    expect(history.now).toBe('b');
    history.become('d');
    expect([history.now, history.canRedo]).toEqual(['d', false]);
    history.undo();
    expect(history.now).toBe('b');
});

test('what is amended or rewritten is not a step', () => {
    const history = new History('a');
    history.become('b');
    history.amend('c');
    history.rewrite(state => state + '!');
    expect(history.now).toBe('c!');
    history.undo();
    expect([history.now, history.canUndo]).toEqual(['a!', false]);
    history.redo();
    expect(history.now).toBe('c!');
});
