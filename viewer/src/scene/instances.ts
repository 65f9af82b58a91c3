// SPDX-License-Identifier: Apache-2.0
// Where a mesh stands in the world: at many places if its node has EXT_mesh_gpu_instancing.
import * as three from 'three';

/** World from mesh, of each instance; of other meshes one. */
export function matricesOf(mesh: three.Mesh): three.Matrix4[] {
    if (!(mesh instanceof three.InstancedMesh)) return [mesh.matrixWorld];
    return Array.from({length: mesh.count}, (_, i) => {
        const matrix = new three.Matrix4();
        mesh.getMatrixAt(i, matrix);
        return matrix.premultiply(mesh.matrixWorld);
    });
}

/** The box of a geometry that a matrix puts into the world. */
export function boxIn(geometry: three.BufferGeometry, world: three.Matrix4): three.Box3 {
    if (geometry.boundingBox === null) geometry.computeBoundingBox();
    return geometry.boundingBox!.clone().applyMatrix4(world);
}
