// SPDX-License-Identifier: Apache-2.0
// The banner above the page: what went wrong, as long as it is true.
import {ApiError, messageOf, Unreachable} from './api';
import {button, element} from './dom';
import {ErrorWithWayOn, WayOn} from './gone';

/** What someone can mend by opening something. */
export class Missing extends Error {}

export class Alerts {
    private action = '';
    private isMissing = false;

    constructor(private readonly banner: HTMLElement) {}

    /** Says what went wrong, until the action works or someone closes it. */
    report(action: string, error: unknown): void {
        if (error instanceof Unreachable) return;  // the banner says so as long as it lasts
        if (error instanceof ApiError && error.status === 401) return;  // a dialog says so
        this.show(messageOf(error), action);
        this.isMissing = error instanceof Missing;
        if (error instanceof ErrorWithWayOn) this.offer(error.way);
        this.banner.append(button('Close', () => this.clear()));
    }

    private offer({text, go}: WayOn): void {
        this.banner.append(button(text, () => {
            this.clear();
            go();
        }));
    }

    show(words: string, action = ''): void {
        this.action = action;
        this.isMissing = false;
        this.banner.replaceChildren(element('span', {}, words));
        this.banner.hidden = false;
    }

    clear(): void {
        this.banner.hidden = true;
        this.action = '';
        this.isMissing = false;
    }

    /** What the action said when it failed before is over. */
    succeed(action: string): void {
        if (action === this.action) this.clear();
    }

    /** Someone went on to open what was missing. */
    forgive(): void {
        if (this.isMissing) this.clear();
    }

    async attempt(action: string, work: () => Promise<unknown>): Promise<void> {
        try {
            await work();
            this.succeed(action);
        } catch (error) {
            this.report(action, error);
        }
    }
}
