// SPDX-License-Identifier: Apache-2.0
import * as three from 'three';

const kShadowTexels = 2048;

/** Shadow maps of suns hold the whole box. */
export function aimShadows(root: three.Object3D, box: three.Box3): void {
    const sphere = box.getBoundingSphere(new three.Sphere());
    root.traverse(node => {
        if (!(node instanceof three.DirectionalLight)) return;
        const from = node.getWorldPosition(new three.Vector3());
        const direction = node.target.getWorldPosition(new three.Vector3()).sub(from).normalize();
        const place = sphere.center.clone().addScaledVector(direction, -2 * sphere.radius);
        node.position.copy(node.parent!.worldToLocal(place));
        const {shadow} = node;
        const texel = 2 * sphere.radius / kShadowTexels;
        shadow.mapSize.set(kShadowTexels, kShadowTexels);
        shadow.normalBias = texel;
        shadow.bias = -texel / (4 * sphere.radius);
        shadow.radius = 0;  // three's wider filter is noisy
        const {camera} = shadow;
        camera.left = camera.bottom = -sphere.radius;
        camera.right = camera.top = sphere.radius;
        camera.near = 0.5 * sphere.radius;
        camera.far = 4 * sphere.radius;
        camera.updateProjectionMatrix();
    });
}
