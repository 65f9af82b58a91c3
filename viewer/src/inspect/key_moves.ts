// SPDX-License-Identifier: Apache-2.0
import * as three from 'three';

const kStep = 0.25;  // metres

/** How far a key moves the selection: along the axis of the world that is nearest to that of the view. */
export function keyMove({key, altKey, shiftKey}: Pick<KeyboardEvent, 'key' | 'altKey' | 'shiftKey'>,
                        camera: three.Camera): three.Vector3 | null {
    const step = shiftKey ? 4 * kStep : kStep;
    if (key === 'PageUp') return new three.Vector3(0, step, 0);
    if (key === 'PageDown') return new three.Vector3(0, -step, 0);
    const turns = {ArrowUp: 0, ArrowRight: 1, ArrowDown: 2, ArrowLeft: 3}[key];
    if (turns === undefined || !altKey) return null;
    const {x, z} = camera.getWorldDirection(new three.Vector3());
    const ahead = Math.round(Math.atan2(x, -z) / (Math.PI / 2));
    const angle = (ahead + turns) * Math.PI / 2;
    return new three.Vector3(step * Math.round(Math.sin(angle)), 0, -step * Math.round(Math.cos(angle)));
}
