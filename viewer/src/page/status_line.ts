// SPDX-License-Identifier: Apache-2.0

const kNewsSeconds = 5;

/** One line: what is shown or under way, and for some seconds what has just happened. */
export class StatusLine {
    private timer = 0;

    constructor(private readonly line: HTMLElement, private readonly state: () => string) {}

    say(words: string): void {
        clearTimeout(this.timer);
        this.timer = 0;
        this.line.textContent = words;
    }

    /** Says the state again after a while. */
    tell(news: string): void {
        this.say(news);
        this.timer = window.setTimeout(() => this.sayState(), 1000 * kNewsSeconds);
    }

    private sayState(): void {
        this.say(this.state());
    }

    /** Something else is shown; news stay their time. */
    follow(): void {
        if (this.timer === 0) this.sayState();
    }
}
