// SPDX-License-Identifier: Apache-2.0
// The light at a place as a white ball and as one colour, as the view shows it.
import {irradiance} from 'tetralight';

import {element} from '../page/dom';
import type {Stage} from '../view/stage';
import {shownColor} from '../view/tone_mapping';

const kSize = 72;  // pixels

/** Mean light on surfaces of all directions, over π. */
export const meanLight = (sh: ArrayLike<number>) => [0, 1, 2].map(channel => sh[channel] * 0.282095 / Math.PI);

export class LightSwatch {
    readonly element: HTMLElement;
    private readonly canvas = element('canvas', {width: kSize, height: kSize, role: 'img', 'aria-label': 'White ball in this light'});
    private readonly patch = element('span', {class: 'patch'});
    private readonly code = element('code');

    constructor() {
        this.element = element('div', {class: 'swatch'}, this.canvas,
                               element('div', {}, 'Average light', element('div', {class: 'color'}, this.patch, this.code)));
    }

    /** As the view shows it now. */
    show(sh: Float32Array, {camera, exposure, toneMapping}: Stage): void {
        const color = shownColor(meanLight(sh), exposure, toneMapping);
        this.patch.style.background = `rgb(${color.join(' ')})`;
        this.code.textContent = '#' + color.map(x => Math.min(255, x).toString(16).padStart(2, '0')).join('');
        const context = this.canvas.getContext('2d')!;
        const picture = context.createImageData(kSize, kSize);
        const [right, up, back] = [0, 1, 2].map(column => camera.matrixWorld.elements.slice(4 * column, 4 * column + 3));
        const radius = kSize / 2 - 1;
        for (let py = 0; py < kSize; ++py) {
            for (let px = 0; px < kSize; ++px) {
                const [x, y] = [(px + 0.5 - kSize / 2) / radius, (kSize / 2 - py - 0.5) / radius];
                const from = Math.sqrt(x * x + y * y);
                const cover = Math.min(1, Math.max(0, (1 - from) * radius + 0.5));
                if (cover === 0) continue;
                const z = Math.sqrt(Math.max(0, 1 - x * x - y * y));
                const scale = 1 / Math.max(1, from);
                const normal = [0, 1, 2].map(i => scale * (right[i] * x + up[i] * y) + back[i] * z);
                const light = irradiance(sh, normal).map(value => value / Math.PI);
                picture.data.set([...shownColor(light, exposure, toneMapping), 255 * cover], 4 * (py * kSize + px));
            }
        }
        context.putImageData(picture, 0, 0);
    }
}
