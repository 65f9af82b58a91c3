// SPDX-License-Identifier: Apache-2.0
import {SphericalHarmonics, SphericalPolynomial} from '@babylonjs/core/Maths/sphericalPolynomial.js';

import {mirrorSh} from '../polynomial_sh.js';
import type {Vector} from '../sh.js';
import {Handedness, shInScene} from './frame.js';

/** The Condon-Shortley sign of each basis function, which Babylon's have. */
const kSigns = [1, -1, 1, -1, 1, -1, 1, -1, 1];

/**
 * The light of a position as `sphericalPolynomial` of an environment texture. It lights all materials that take their
 * environment from the scene or have the texture, without a rotation of its own. In right-handed scenes Babylon mirrors the
 * z of normals before it reads an environment.
 */
export function sphericalPolynomial(sh: Vector, scene: Handedness): SphericalPolynomial {
    const inScene = shInScene(sh, scene);
    if (scene.useRightHandedSystem) mirrorSh(inScene, 'z');
    const harmonics = new SphericalHarmonics();
    harmonics.updateFromFloatsArray(inScene.map((value, i) => value * kSigns[Math.floor(i / 3)] / Math.PI));
    return SphericalPolynomial.FromHarmonics(harmonics);
}
