// SPDX-License-Identifier: Apache-2.0
import * as three from 'three';
import {expect, test} from 'vitest';

import type {Groups} from '../src/groups';
import {GroupsEditor} from '../src/groups_editor';

const kHall: Groups = [{name: 'hall', positions: [[0, 0, 0]]}];
const kGrid: Groups = [{name: 'grid', positions: [[1, 1, 1], [2, 2, 2]]}];

function makeEditor(): GroupsEditor {
    const stage = {scene: new three.Scene(), draw: () => {}};
    const api = {upload: () => Promise.reject(new Error('no server'))};
    return new GroupsEditor(stage as never, {} as never, api as never, () => {}, {report: () => {}} as never);
}

test('opening others is a step to undo, and the first opening is none', () => {
    const editor = makeEditor();
    editor.open(kHall);
    expect(editor.canUndo).toBe(false);
    editor.addAt([3, 3, 3]);
    const edited = editor.now;
    editor.open(kGrid);
    expect(editor.now).toBe(kGrid);
    editor.undo();
    expect(editor.now).toBe(edited);
    editor.undo();
    expect(editor.now).toBe(kHall);
});

test('groups are unsaved from an edit until they are kept or the edit is undone', () => {
    const editor = makeEditor();
    expect(editor.isUnsaved).toBe(false);
    editor.keep(kHall);
    editor.open(kHall);
    expect(editor.isUnsaved).toBe(false);
    editor.addAt([3, 3, 3]);
    expect(editor.isUnsaved).toBe(true);
    editor.keep(editor.now);
    expect(editor.isUnsaved).toBe(false);
    editor.selectAll();
    editor.removeSelected();
    expect(editor.isUnsaved).toBe(true);
    editor.undo();
    expect(editor.isUnsaved).toBe(false);
    editor.open(kGrid);
    expect(editor.isUnsaved).toBe(true);
});
