// SPDX-License-Identifier: Apache-2.0
// All that the tab Edit changes, and what is selected: one history for all kinds of edits.
import type {Box, BoxKindId} from './boxes';
import type {Groups, Ref} from './groups';
import {History} from './history';

export type EditKind = 'groups' | BoxKindId;

export interface EditState {
    readonly groups: Groups;
    readonly boxes: readonly Box[];
    /** Which of them is edited. */
    readonly kind: EditKind;
    readonly probes: readonly Ref[];
    /** The index of the selected box, or −1. */
    readonly box: number;
}

/** What is selected changes without a step to undo. */
export type Choice = Partial<Pick<EditState, 'kind' | 'probes' | 'box'>>;

export class EditSession {
    private readonly history = new History<EditState>({groups: [], boxes: [], kind: 'groups', probes: [], box: -1});
    private readonly keptGroups = new WeakSet<Groups>();
    private readonly keptBoxes = new WeakSet<readonly Box[]>();
    private readonly listeners: ((isEdit: boolean) => void)[] = [];

    constructor() {
        this.keptBoxes.add(this.now.boxes);
    }

    /** Called after each edit, undo and redo, and (not an edit) after each selection. */
    onChange(listener: (isEdit: boolean) => void): void {
        this.listeners.push(listener);
    }

    get now(): EditState {
        return this.history.now;
    }

    get canUndo(): boolean {
        return this.history.canUndo;
    }

    get canRedo(): boolean {
        return this.history.canRedo;
    }

    /** Whether the groups are neither stored nor those of a volume. */
    get hasUnsavedGroups(): boolean {
        return this.now.groups.length > 0 && !this.keptGroups.has(this.now.groups);
    }

    /** Whether the boxes are not those of a stored scene. */
    get hasUnsavedBoxes(): boolean {
        return !this.keptBoxes.has(this.now.boxes);
    }

    keepGroups(groups: Groups): void {
        this.keptGroups.add(groups);
    }

    keepBoxes(boxes: readonly Box[]): void {
        this.keptBoxes.add(boxes);
        this.changed(false);
    }

    edit(changes: Partial<EditState>): void {
        this.history.become({...this.now, ...changes});
        this.changed(true);
    }

    choose(choice: Choice): void {
        this.history.amend({...this.now, ...choice});
        this.changed(false);
    }

    /** Others instead of those that are open; undo brings these back. */
    openGroups(groups: Groups): void {
        if (this.now.groups.length > 0) {
            this.history.become({...this.now, groups, probes: []});
        } else {  // there is nothing to bring back
            this.history.rewrite(state => state.groups.length === 0 ? {...state, groups, probes: []} : state);
        }
        this.changed(true);
    }

    /** The boxes of another scene. Edits that are not saved are brought back by undo. */
    openBoxes(boxes: readonly Box[]): void {
        this.keptBoxes.add(boxes);
        if (this.hasUnsavedBoxes) this.history.become({...this.now, boxes, box: -1});
        else this.history.rewrite(state => ({...state, boxes, box: -1}));
        this.changed(true);
    }

    undo(): void {
        this.history.undo();
        this.changed(true);
    }

    redo(): void {
        this.history.redo();
        this.changed(true);
    }

    private changed(isEdit: boolean): void {
        for (const listener of this.listeners) listener(isEdit);
    }
}
