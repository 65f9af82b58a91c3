// SPDX-License-Identifier: Apache-2.0
import type * as three from 'three';

import type {OpenVolume} from '../light/volume';
import type {Bake} from '../page/api';
import type {SceneModel} from './scene_model';

/** What the page shows. */
export interface Shown {
    readonly volume: OpenVolume | null;
    readonly model: SceneModel | null;
    /** Of the volume, if it is known. */
    readonly bake: Bake | null;
    /** Of all of it. */
    readonly box: three.Box3;
}
