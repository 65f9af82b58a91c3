// SPDX-License-Identifier: Apache-2.0
// Buttons on the view, and the dialog that lists keys.
import {button, element} from './dom';

const kKeys: [string, string][] = [
    ['Drag, arrow keys', 'turn the camera'],
    ['Middle or right drag, Shift + arrow keys', 'move the camera'],
    ['Wheel, + and −', 'zoom, to the pointer'],
    ['F', 'frame the selection'],
    ['Home, Shift + F', 'frame everything'],
    ['Click', 'select an object, a probe or the ball'],
    ['Double click, Shift + click', 'put the ball on a surface'],
    ['Drag the ball or an object that moves', 'move it on its level; with Shift up and down'],
    ['Alt + arrow keys, Page Up, Page Down', 'move the selection'],
    ['Alt + drag', 'turn the camera, also over the ball'],
    ['Esc', 'select nothing'],
    ['A, Del, Ctrl + D', 'in the tab Edit: add, delete, duplicate'],
    ['Ctrl + Z, Ctrl + Y', 'in the tab Edit: undo, redo'],
    ['W, E, R', 'in the tab Edit: handles that move, rotate, size'],
    ['?', 'this list'],
];

export interface ViewActions {
    frameSelection(): void;
    frameAll(): void;
    savePicture(): void;
}

/** `canvas` has the focus when the keys count. */
export function viewTools(canvas: HTMLElement, actions: ViewActions): HTMLElement {
    const dialog = helpDialog();
    const help = () => dialog.showModal();
    const keys: Record<string, () => void> = {
        f: actions.frameSelection, F: actions.frameAll, Home: actions.frameAll, '?': help};
    canvas.addEventListener('keydown', event => {
        const act = keys[event.key];
        if (act === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
        event.preventDefault();
        act();
    });
    return element('div', {class: 'tools'},
                   button('Frame', actions.frameSelection, {title: 'Frame the selection: F'}),
                   button('Frame all', actions.frameAll, {title: 'Frame everything: Home'}),
                   button('Save picture', actions.savePicture, {title: 'Save the view as a PNG'}),
                   button('?', help, {title: 'Keys', 'aria-label': 'Keys and mouse'}));
}

function helpDialog(): HTMLDialogElement {
    const rows = kKeys.map(([keys, effect]) => element('tr', {}, element('th', {scope: 'row'}, keys), element('td', {}, effect)));
    const dialog: HTMLDialogElement = element(
        'dialog', {class: 'help', 'aria-labelledby': 'help-title'}, element('h2', {id: 'help-title'}, 'Keys and mouse'),
        element('p', {class: 'hint'}, 'Keys count while the view has the focus: click it, or reach it with Tab.'),
        element('table', {}, element('tbody', {}, ...rows)),
        element('div', {class: 'buttons'}, button('Close', () => dialog.close())));
    document.body.append(dialog);
    return dialog;
}
