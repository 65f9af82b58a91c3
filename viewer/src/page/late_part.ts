// SPDX-License-Identifier: Apache-2.0

/** A part of the page that is fetched when it is first used, so that the page starts sooner. */
export class LatePart<T> {
    /** Null before it has been fetched. */
    value: T | null = null;
    private coming: Promise<T> | null = null;

    constructor(private readonly make: () => Promise<T>) {}

    /** After a failure, the next call fetches it again. */
    get(): Promise<T> {
        this.coming ??= this.make().then(value => this.value = value).catch(error => {
            this.coming = null;
            throw error;
        });
        return this.coming;
    }

    /** Resolves when nothing is on its way. */
    async settled(): Promise<void> {
        await this.coming?.catch(() => {});
    }
}
