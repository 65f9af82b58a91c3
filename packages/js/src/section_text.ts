// SPDX-License-Identifier: Apache-2.0
// Names and metadata in files.
import {sectionError} from './error.js';
import type {SectionFile} from './section_file.js';

/** C0, DEL and C1. */
const isControl = (code: number) => code < 0x20 || (code >= 0x7f && code < 0xa0);

/** Names that are each ended by a line break. */
export function readNames(file: SectionFile, section: string): string[] {
    return splitNames(section, file.text(section));
}

export function splitNames(section: string, text: string): string[] {
    if (text !== '' && !text.endsWith('\n')) throw sectionError(section, 'the last name has no line break at its end');
    const names = text.split('\n').slice(0, -1);
    names.forEach((name, i) => {
        for (let k = 0; k < name.length; ++k) {
            if (isControl(name.charCodeAt(k))) throw sectionError(section, `name ${i} holds a control character`);
        }
    });
    return names;
}

/** Tabs and line breaks are the only control characters that metadata may have. */
export function checkMetadata(metadata: string): void {
    for (let i = 0; i < metadata.length; ++i) {
        const code = metadata.charCodeAt(i);
        if (isControl(code) && code !== 9 && code !== 10 && code !== 13) {
            throw sectionError('metadata', `character ${i} is a control character`);
        }
    }
}

export function checkDistinctNames(section: string, names: readonly string[]): void {
    const twice = names.find((name, i) => names.indexOf(name) !== i);
    if (twice !== undefined) throw sectionError(section, `name "${twice}" occurs twice`);
}
