// SPDX-License-Identifier: Apache-2.0
// Whether a mesh is fine enough for its light to be found at its vertices instead of its pixels.
import * as three from 'three';

/** True if no edge of a triangle is longer than `length`, metres. */
export function isDense(geometry: three.BufferGeometry, worldFromMesh: three.Matrix4, length: number): boolean {
    const position = geometry.getAttribute('position');
    if (position === undefined || geometry.getAttribute('normal') === undefined) return false;
    const {index} = geometry;
    const corner = (i: number) => index === null ? i : index.getX(i);
    const places = Float32Array.from({length: 3 * position.count});
    const at = new three.Vector3();
    for (let i = 0; i < position.count; ++i) {
        at.fromBufferAttribute(position, i).applyMatrix4(worldFromMesh).toArray(places, 3 * i);
    }
    const count = index === null ? position.count : index.count;
    for (let i = 0; i + 2 < count; i += 3) {
        const [a, b, c] = [3 * corner(i), 3 * corner(i + 1), 3 * corner(i + 2)];
        if (squareBetween(places, a, b) > length ** 2 || squareBetween(places, b, c) > length ** 2 ||
            squareBetween(places, c, a) > length ** 2) return false;
    }
    return true;
}

const squareBetween = (p: Float32Array, a: number, b: number) =>
    (p[a] - p[b]) ** 2 + (p[a + 1] - p[b + 1]) ** 2 + (p[a + 2] - p[b + 2]) ** 2;
