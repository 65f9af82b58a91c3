// SPDX-License-Identifier: Apache-2.0
// What lies beside the volume, as gallery.json.
import type {Position} from './road.js';

export interface Input {
    exposure: number;
    /** A picture of the scene, with the camera `kOverview`. */
    overview: string;
    /** The ball, as the command renders it: one picture for each station. */
    stations: {position: Position; picture: string}[];
}
