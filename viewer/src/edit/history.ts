// SPDX-License-Identifier: Apache-2.0

/** The states of a document for undo and redo. States are values: nobody changes them. */
export class History<State> {
    private past: State[] = [];
    private future: State[] = [];

    constructor(private present: State) {}

    get now(): State {
        return this.present;
    }

    get canUndo(): boolean {
        return this.past.length > 0;
    }

    get canRedo(): boolean {
        return this.future.length > 0;
    }

    become(state: State): void {
        this.past.push(this.present);
        this.present = state;
        this.future = [];
    }

    /** Replaces the present without a step to undo. */
    amend(state: State): void {
        this.present = state;
    }

    /** Replaces all states, such as when something is opened that no step has changed. */
    rewrite(change: (state: State) => State): void {
        this.past = this.past.map(change);
        this.present = change(this.present);
        this.future = this.future.map(change);
    }

    undo(): void {
        const state = this.past.pop();
        if (state === undefined) return;
        this.future.push(this.present);
        this.present = state;
    }

    redo(): void {
        const state = this.future.pop();
        if (state === undefined) return;
        this.past.push(this.present);
        this.present = state;
    }
}
