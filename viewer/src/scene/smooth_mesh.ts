// SPDX-License-Identifier: Apache-2.0
// Whether light that depends on the normal alone may be found at the vertices of a mesh instead of its pixels.
import * as three from 'three';

/** Interpolated over such a triangle, light of L2 is off by about a fiftieth of its changes. */
const kMostAngle = 15;  // degrees

/** True if the normals of each triangle differ by at most 15 degrees. */
export function isSmooth(geometry: three.BufferGeometry): boolean {
    const normal = geometry.getAttribute('normal');
    if (normal === undefined) return false;
    const {index} = geometry;
    const count = index === null ? normal.count : index.count;
    const least = Math.cos(three.MathUtils.degToRad(kMostAngle));
    const corners = [0, 1, 2].map(() => new three.Vector3());
    for (let i = 0; i + 2 < count; i += 3) {
        corners.forEach((corner, k) => corner.fromBufferAttribute(normal, index === null ? i + k : index.getX(i + k)).normalize());
        const [a, b, c] = corners;
        if (a.dot(b) < least || b.dot(c) < least || c.dot(a) < least) return false;
    }
    return true;
}
