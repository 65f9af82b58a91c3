// SPDX-License-Identifier: Apache-2.0
// Pictures of the pages of lightmaps.
import type {Lightmaps} from 'tetralight';
import * as three from 'three';

import {element} from '../page/dom';
import {middleGreyExposure} from '../view/exposure';

/** RGBA bytes of a page, the row of v = 1 first: irradiance / π, exposed to middle grey, compressed by x / (1 + x), sRGB.
 * Texels without light are transparent. */
export function pagePixels({pageSize, scale, irradiance}: Pick<Lightmaps, 'pageSize' | 'scale' | 'irradiance'>,
                           page: number): Uint8ClampedArray<ArrayBuffer> {
    const count = pageSize * pageSize;
    const texels = Float32Array.from(irradiance.subarray(4 * count * page, 4 * count * (page + 1)), three.DataUtils.fromHalfFloat);
    for (let i = 0; i < texels.length; ++i) if (i % 4 < 3) texels[i] *= texels[i | 3] > 0 ? scale / Math.PI : 0;
    const exposure = middleGreyExposure(texels);
    const pixels = new Uint8ClampedArray(4 * count);
    const color = new three.Color();
    for (let i = 0; i < count; ++i) {
        const [r, g, b] = [0, 1, 2].map(channel => exposure * texels[4 * i + channel]).map(x => x / (1 + x));
        color.setRGB(r, g, b).convertLinearToSRGB();
        const row = pageSize - 1 - Math.floor(i / pageSize);
        const at = 4 * (row * pageSize + i % pageSize);
        pixels.set([255 * color.r, 255 * color.g, 255 * color.b, texels[4 * i + 3] > 0 ? 255 : 0], at);
    }
    return pixels;
}

/** Fills a list with a picture of each page. */
export function showPages(list: HTMLElement, lightmaps: Lightmaps | null): void {
    const {pageSize = 0, pageCount = 0} = lightmaps ?? {};
    list.replaceChildren(...Array.from({length: pageCount}, (_, page) => {
        const canvas = element('canvas', {width: pageSize, height: pageSize, role: 'img', 'aria-label': `Page ${page}`});
        canvas.getContext('2d')!.putImageData(new ImageData(pagePixels(lightmaps!, page), pageSize, pageSize), 0, 0);
        return element('figure', {}, canvas, element('figcaption', {}, `Page ${page}`));
    }));
}
