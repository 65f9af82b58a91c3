// SPDX-License-Identifier: Apache-2.0
import {element} from './dom';

/** Hands a file to the browser, which saves it. */
export function download(name: string, content: BlobPart, type: string): void {
    const url = URL.createObjectURL(new Blob([content], {type}));
    element('a', {href: url, download: name}).click();
    setTimeout(() => URL.revokeObjectURL(url), 60000);  // a browser may ask where to save it
}
