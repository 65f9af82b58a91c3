// SPDX-License-Identifier: Apache-2.0
// What is selected, in words.
import type * as three from 'three';

import type {OpenVolume} from '../light/volume';
import type {SceneObject} from '../scene/scene_objects';
import {probeWords} from './light_card';

export type Selected = {kind: 'ball'} | {kind: 'none'} | {kind: 'probe'; probe: number} |
    /** `place` has the light; `normal` is that of the surface there, of static objects. */
    {kind: 'object'; object: SceneObject; place: three.Vector3; normal: three.Vector3 | null};

export const objectOf = (selected: Selected) => selected.kind === 'object' ? selected.object : null;

export function titleOfSelected(selected: Selected): string {
    if (selected.kind === 'object') return selected.object.name;
    if (selected.kind === 'probe') return `Probe ${selected.probe}`;
    return selected.kind === 'ball' ? 'Ball' : 'Nothing is selected';
}

export function hintOf(selected: Selected, volume: OpenVolume | null): string {
    if (selected.kind === 'ball') {
        if (volume === null) return 'The ball shows the light of probes: open a volume, or bake one.';
        return 'Drag the ball, or double-click a surface to put it there. The yellow cell is where it lies.';
    }
    if (selected.kind === 'probe') return volume === null ? '' : probeWords(volume, selected.probe) + '.';
    if (selected.kind === 'none') return 'Click anything in the scene, or choose it below.';
    return selected.object.isStatic ?
        'It cannot move here: it is static, so its shadow and its bounces are in the baked light. ' +
        'Set contribute_gi to false in the scene to move it.' :
        'It moves: drag it, and its light follows.';
}
