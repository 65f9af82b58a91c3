// SPDX-License-Identifier: Apache-2.0
import * as three from 'three';
import {beforeEach, expect, test} from 'vitest';

import {BoxEditor} from '../../src/edit/box_editor';
import {makeBox} from '../../src/edit/box_kinds';
import type {Box} from '../../src/edit/boxes';
import {EditSession} from '../../src/edit/edit_session';
import {Snapping} from '../../src/view/snapping';

let session: EditSession;
let snapping: Snapping;
let editor: BoxEditor;

/** A view along −z, 100 pixels a metre. */
const kStage = {
    scene: new three.Scene(), draw: () => {},
    pageFrom: (p: three.Vector3) => ({x: 100 * p.x, y: -100 * p.y, isInFront: true}),
    rayAt: (x: number, y: number) => ({ray: new three.Ray(new three.Vector3(x / 100, -y / 100, 10), new three.Vector3(0, 0, -1))}),
};

const kRoom: Box = {...makeBox('adjustments', 'room', [0, 0, 0]), size: [4, 4, 4]};
const kShelf: Box = {...makeBox('adjustments', 'shelf', [1.5, 1.5, 3]), size: [1, 1, 1]};
const kWindow = makeBox('portals', 'window', [3, 0, 0]);

beforeEach(() => {
    session = new EditSession();
    snapping = new Snapping();
    editor = new BoxEditor(session, kStage as never, {attach: () => {}, detach: () => {}} as never, snapping, () => {});
    session.openBoxes([kRoom, kShelf, kWindow]);
    session.choose({kind: 'adjustments'});
});

test('a click takes the point, the outline, then the nearest face, and only of the kind that is edited', () => {
    const clicked = (x: number, y: number) => {
        editor.click(100 * x, -100 * y);
        return editor.selected?.name;
    };
    expect(clicked(0.05, 0.05)).toBe('room');
    expect(clicked(1.5, 1.5)).toBe('shelf');
    expect(clicked(1.2, 1.2)).toBe('shelf');  // its face is in front of the room's
    expect(clicked(-1, -1)).toBe('room');
    expect(clicked(-1.97, 0)).toBe('room');
    expect(clicked(3, 0)).toBeUndefined();
    session.choose({kind: 'portals'});
    expect(clicked(3, 0)).toBe('window');
});

test('a handle moves its side in steps, and the drag is one edit', () => {
    editor.select(0);
    expect(editor.press(200, 0)).toBe(false);  // these are the handles that move
    editor.handles = 'size';
    expect(editor.press(100, 100)).toBe(false);
    expect(editor.press(203, 3)).toBe(true);
    editor.dragTo(250, 0);
    editor.dragTo(263, 90);
    expect(editor.selected!.size).toEqual([4.5, 4, 4]);
    expect(session.now.boxes[0]).toBe(kRoom);
    editor.release();
    expect(session.now.boxes[0]).toEqual({...kRoom, size: [4.5, 4, 4], position: [0.25, 0, 0]});
    session.undo();
    expect(session.now.boxes[0]).toBe(kRoom);
    snapping.isHeldOff = true;
    editor.press(200, 0);
    editor.dragTo(233, 0);
    editor.release();
    expect(editor.selected!.size[0]).toBeCloseTo(4.33);
});

test('what is added comes to multiples of the step, has a free name, and is selected', () => {
    editor.addAt([0.13, 1, -0.6]);
    expect(editor.selected).toMatchObject({name: 'volume', position: [0.25, 1, -0.5], settings: {forbid: true}});
    editor.duplicateSelected();
    expect(editor.selected!.name).toBe('volume 2');
    editor.removeSelected();
    expect(editor.selected).toBeNull();
    expect(session.now.boxes.map(({name}) => name)).toEqual(['room', 'shelf', 'window', 'volume']);
});
