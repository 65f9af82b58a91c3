// SPDX-License-Identifier: Apache-2.0

/** What a program can branch on; messages are for people. */
export type ErrorCode = 'corrupt' | 'unsupported' | 'invalid_argument' | 'not_found';

/** A file that cannot be used, or an argument that cannot be right. */
export class TetralightError extends Error {
    override readonly name = 'TetralightError';

    /** `field` is the section, element or argument at fault: `cells[7]`, `weights`. */
    constructor(readonly code: ErrorCode, readonly field: string, message: string) {
        super(message);
    }
}

export function sectionError(section: string, what: string): TetralightError {
    return new TetralightError('corrupt', section, `section "${section}": ${what}`);
}

export function elementError(section: string, element: number, what: string): TetralightError {
    return new TetralightError('corrupt', `${section}[${element}]`, `section "${section}": element ${element}: ${what}`);
}

export function argumentError(name: string, what: string): TetralightError {
    return new TetralightError('invalid_argument', name, `${name} ${what}`);
}
