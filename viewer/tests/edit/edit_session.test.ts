// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {makeBox} from '../../src/edit/box_kinds';
import {EditSession} from '../../src/edit/edit_session';
import type {Groups} from '../../src/edit/groups';

const kHall: Groups = [{name: 'hall', positions: [[0, 0, 0]]}];
const kPortal = makeBox('portals', 'window', [0, 1, 0]);
const kVolume = makeBox('adjustments', 'volume', [0, 1, 0]);

test('one history holds edits of groups and of boxes, and undo returns to the kind of the edit', () => {
    const session = new EditSession();
    session.openGroups(kHall);
    session.choose({kind: 'portals'});
    session.edit({boxes: [kPortal], box: 0});
    session.choose({kind: 'groups'});
    session.edit({groups: []});
    session.choose({kind: 'adjustments'});
    session.undo();
    expect(session.now).toMatchObject({groups: kHall, boxes: [kPortal], kind: 'groups'});
    session.undo();
    expect(session.now).toMatchObject({groups: kHall, boxes: [], kind: 'portals'});
    expect(session.canUndo).toBe(false);
    session.redo();
    session.redo();
    expect(session.now).toMatchObject({groups: [], boxes: [kPortal]});
});

test('opening groups after an edit of boxes is not undone with that edit', () => {
    const session = new EditSession();
    session.edit({boxes: [kPortal]});
    session.openGroups(kHall);
    session.undo();
    expect(session.now).toMatchObject({groups: kHall, boxes: []});
});

test('boxes are unsaved from an edit until they are kept, or undone', () => {
    const session = new EditSession();
    session.openBoxes([kPortal]);
    expect(session.hasUnsavedBoxes).toBe(false);
    session.edit({boxes: [kPortal, kVolume]});
    expect(session.hasUnsavedBoxes).toBe(true);
    session.undo();
    expect(session.hasUnsavedBoxes).toBe(false);
    session.redo();
    session.keepBoxes(session.now.boxes);
    expect(session.hasUnsavedBoxes).toBe(false);
});

test('the boxes of another scene leave unsaved ones to undo', () => {
    const session = new EditSession();
    session.openBoxes([kPortal]);
    session.edit({boxes: [kPortal, kVolume]});
    session.openBoxes([]);
    expect(session.now.boxes).toEqual([]);
    session.undo();
    expect(session.now.boxes).toEqual([kPortal, kVolume]);
    session.keepBoxes(session.now.boxes);
    session.openBoxes([kVolume]);
    session.undo();
    expect(session.now.boxes).toEqual([kVolume]);
});
