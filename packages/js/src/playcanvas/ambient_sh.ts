// SPDX-License-Identifier: Apache-2.0
import type {Scene, StandardMaterial} from 'playcanvas';

import {polynomialSh, turnPolynomialSh} from '../polynomial_sh.js';
import {kCoefficients, Vector} from '../sh.js';

/** Our index of each coefficient of PlayCanvas: 1, x, y, z, xz, zy, yx, 3z² − 1, x² − y². */
const kOrder = [0, 3, 1, 2, 7, 5, 4, 6, 8];

/**
 * The light of a position as `StandardMaterial.ambientSH` and the parameter `ambientSH[0]` of mesh instances take it.
 * Materials that reflect the sky of their scene turn it with the sky and multiply it by the sky's intensity: `sky` undoes
 * both.
 */
export function ambientSh(sh: Vector, sky: SkyOfLight = kNoSky): Float32Array {
    let from = polynomialSh(sh);
    if (sky.rotation !== kNoSky.rotation) from = turnPolynomialSh(from, sky.rotation);
    return Float32Array.from({length: kCoefficients},
                             (_, i) => from[3 * kOrder[Math.floor(i / 3)] + i % 3] / sky.intensity);
}

/** What a shader does with `ambientSH`. */
export interface SkyOfLight {
    /** What turns normals, by rows. */
    readonly rotation: readonly number[];
    readonly intensity: number;
}

export const kNoSky: SkyOfLight = {rotation: [1, 0, 0, 0, 1, 0, 0, 0, 1], intensity: 1};

/** The sky that a material reflects. One of its own does not change the light. */
export function skyOf(material: StandardMaterial, scene: Scene): SkyOfLight {
    const hasOwn = material.envAtlas || material.cubeMap || material.sphereMap;
    if (!material.useSkybox || hasOwn || !(scene.envAtlas || scene.skybox)) return kNoSky;
    const intensity = scene.physicalUnits ? scene.skyboxLuminance : scene.skyboxIntensity;
    // A sky without intensity blackens all ambient light.
    return {rotation: rowsOf(scene.skyboxRotation), intensity: intensity > 0 ? intensity : 1};
}

/** The rotation by a unit quaternion. The shader multiplies row vectors by its inverse, which is the same. */
function rowsOf({x, y, z, w}: {x: number; y: number; z: number; w: number}): number[] {
    return [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),
            2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
            2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)];
}
