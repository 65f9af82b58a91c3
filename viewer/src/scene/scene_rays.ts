// SPDX-License-Identifier: Apache-2.0
// Rays and distances to the triangles of a scene, both sides of each.
import * as three from 'three';

import {boxIn, matricesOf} from './instances';

export interface Hit {
    distance: number;
    point: three.Vector3;
    /** Towards where the ray came from. */
    normal: three.Vector3;
    /** The ray hit the back of the surface: it came from inside. */
    isBack: boolean;
}

/** A mesh, or one of its instances. */
interface Part {
    geometry: three.BufferGeometry;
    world: three.Matrix4;
    box: three.Box3;
}

function partsOf(mesh: three.Mesh): Part[] {
    const {geometry} = mesh;
    return matricesOf(mesh).map(world => ({geometry, world, box: boxIn(geometry, world)}));
}

export class SceneRays {
    private readonly parts: Part[] = [];

    /** The scene as it is now. */
    constructor(root: three.Object3D) {
        root.updateWorldMatrix(true, true);
        root.traverse(node => { if (node instanceof three.Mesh) this.parts.push(...partsOf(node)); });
    }

    /** The nearest hit of a ray of the world, or null. */
    hit(ray: three.Ray): Hit | null {
        let nearest: Hit | null = null;
        const point = new three.Vector3();
        for (const part of this.parts) {
            if (!ray.intersectsBox(part.box)) continue;
            forTriangles(part, ([a, b, c]) => {
                if (ray.intersectTriangle(a, b, c, false, point) === null) return;
                const distance = point.distanceTo(ray.origin);
                if (nearest !== null && distance >= nearest.distance) return;
                const normal = new three.Triangle(a, b, c).getNormal(new three.Vector3());
                const isBack = normal.dot(ray.direction) > 0;
                nearest = {distance, point: point.clone(), normal: isBack ? normal.negate() : normal, isBack};
            });
        }
        return nearest;
    }

    /** How far the nearest surface is from a place; `most` if none is nearer. */
    clearance(place: three.Vector3, most: number): number {
        let nearest = most;
        const sphere = new three.Sphere(place, most);
        const box = new three.Box3();
        const triangle = new three.Triangle();
        const closest = new three.Vector3();
        for (const part of this.parts) {
            if (!part.box.intersectsSphere(sphere)) continue;
            forTriangles(part, corners => {
                if (!box.setFromPoints(corners).intersectsSphere(sphere)) return;
                triangle.set(...corners).closestPointToPoint(place, closest);
                nearest = Math.min(nearest, closest.distanceTo(place));
            });
        }
        return nearest;
    }
}

/** Corners in the world; the same objects each time. */
function forTriangles({geometry, world}: Part,
                      work: (corners: [three.Vector3, three.Vector3, three.Vector3]) => void): void {
    const positions = geometry.getAttribute('position');
    const {index} = geometry;
    const corners = [new three.Vector3(), new three.Vector3(), new three.Vector3()] as [three.Vector3, three.Vector3, three.Vector3];
    const count = index?.count ?? positions.count;
    for (let i = 0; i + 2 < count; i += 3) {
        corners.forEach((corner, k) => {
            corner.fromBufferAttribute(positions, index === null ? i + k : index.getX(i + k)).applyMatrix4(world);
        });
        work(corners);
    }
}
