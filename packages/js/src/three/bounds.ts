// SPDX-License-Identifier: Apache-2.0
import type * as three from 'three';

/** The center of the bounds of a geometry, local. */
export function centerOfBounds(geometry: three.BufferGeometry): three.Vector3 {
    if (!geometry.boundingSphere) geometry.computeBoundingSphere();
    return geometry.boundingSphere!.center;
}
