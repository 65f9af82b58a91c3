// SPDX-License-Identifier: Apache-2.0
import type {Volume} from '../src/index.js';
import type {Position} from './road.js';

/** The ball in one engine, on a canvas. Pictures are sRGB, without tone mapping, with an exposure. */
export interface BallView {
    readonly name: string;
    draw(position: Position): Promise<void>;
}

export type MakeBallView = (canvas: HTMLCanvasElement, volume: Volume, exposure: number) => Promise<BallView>;
