// SPDX-License-Identifier: Apache-2.0

/**
 * One request at a time; of what is asked meanwhile, only the newest is sent. Answers are shown in the
 * order of their questions, and none of before `forget`.
 */
export class Newest<Question, Answer> {
    private waiting: Question | undefined;
    private isBusy = false;
    private age = 0;

    constructor(private readonly send: (question: Question) => Promise<Answer>,
                private readonly show: (answer: Answer, question: Question) => void,
                private readonly fail: (error: unknown) => void) {}

    ask(question: Question): void {
        this.waiting = question;
        if (!this.isBusy) void this.work();
    }

    /** Whether something newer was asked than what is shown next. */
    get isWaiting(): boolean {
        return this.waiting !== undefined;
    }

    /** What was asked until now is of no interest any more. */
    forget(): void {
        ++this.age;
        this.waiting = undefined;
    }

    private async work(): Promise<void> {
        this.isBusy = true;
        while (this.waiting !== undefined) {
            const question = this.waiting;
            const age = this.age;
            this.waiting = undefined;
            try {
                const answer = await this.send(question);
                if (age === this.age) this.show(answer, question);
            } catch (error) {
                if (age === this.age) this.fail(error);
            }
        }
        this.isBusy = false;
    }
}
