// SPDX-License-Identifier: Apache-2.0
import * as three from 'three';
import {expect, test} from 'vitest';

import {EditSession} from '../../src/edit/edit_session';
import type {Groups} from '../../src/edit/groups';
import {GroupsEditor} from '../../src/edit/groups_editor';

const kHall: Groups = [{name: 'hall', positions: [[0, 0, 0]]}];
const kGrid: Groups = [{name: 'grid', positions: [[1, 1, 1], [2, 2, 2]]}];

function makeEditor(): [GroupsEditor, EditSession] {
    const stage = {scene: new three.Scene(), draw: () => {}};
    const api = {upload: () => Promise.reject(new Error('no server'))};
    const session = new EditSession();
    return [new GroupsEditor(session, stage as never, {} as never, api as never, () => {}, {report: () => {}} as never), session];
}

test('opening others is a step to undo, and the first opening is none', () => {
    const [editor, session] = makeEditor();
    editor.open(kHall);
    expect(session.canUndo).toBe(false);
    editor.addAt([3, 3, 3]);
    const edited = editor.now;
    editor.open(kGrid);
    expect(editor.now).toBe(kGrid);
    session.undo();
    expect(editor.now).toBe(edited);
    session.undo();
    expect(editor.now).toBe(kHall);
});

test('groups are unsaved from an edit until they are kept or the edit is undone', () => {
    const [editor, session] = makeEditor();
    expect(session.hasUnsavedGroups).toBe(false);
    session.keepGroups(kHall);
    editor.open(kHall);
    expect(session.hasUnsavedGroups).toBe(false);
    editor.addAt([3, 3, 3]);
    expect(session.hasUnsavedGroups).toBe(true);
    session.keepGroups(editor.now);
    expect(session.hasUnsavedGroups).toBe(false);
    editor.selectAll();
    editor.removeSelected();
    expect(session.hasUnsavedGroups).toBe(true);
    session.undo();
    expect(session.hasUnsavedGroups).toBe(false);
    editor.open(kGrid);
    expect(session.hasUnsavedGroups).toBe(true);
});
