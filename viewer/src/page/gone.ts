// SPDX-License-Identifier: Apache-2.0
// Words for what a link names and the server no longer has, and a way on.
import {ApiError} from './api';

/** A button beside an error. */
export interface WayOn {
    text: string;
    go: () => void;
}

export class ErrorWithWayOn extends Error {
    constructor(words: string, readonly way: WayOn) {
        super(words);
    }
}

/** Opens what a link names; if the server does not have it, the error says so and offers another way. */
export async function openOrExplain(noun: string, reference: string, open: () => Promise<unknown>, way: WayOn): Promise<void> {
    try {
        await open();
    } catch (error) {
        if (!(error instanceof ApiError && error.status === 404)) throw error;
        const name = /^[0-9a-f]{32,64}$/.test(reference) ? reference.slice(0, 8) : reference;
        throw new ErrorWithWayOn(`The ${noun} "${name}" is not on this server any more. It was deleted, or the link is from ` +
                                 'another server. Choose another one above.', way);
    }
}

/** The scene of a volume is gone, but the volume itself can be shown. */
export function explainScene(error: unknown, volume: string): unknown {
    if (!(error instanceof ApiError) || error.status !== 404) return error;
    return new ApiError(error.status, error.code, `The scene of ${volume} was deleted: the volume is shown without it. ` +
                        'Upload the scene again, or open another one.', error.field);
}
