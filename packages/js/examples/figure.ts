// SPDX-License-Identifier: Apache-2.0
// A figure of one skinned mesh that walks.
import * as three from 'three';
import {mergeGeometries} from 'three/addons/utils/BufferGeometryUtils.js';

/** Parts: the place of the joint in the body, metres, and the capsule that hangs from it or stands on it. */
const kParts = [
    {joint: [0, 0.9, 0], radius: 0.17, length: 0.4, isUp: true},      // body
    {joint: [0, 1.5, 0], radius: 0.13, length: 0.06, isUp: true},     // head
    {joint: [-0.1, 0.9, 0], radius: 0.08, length: 0.7, isUp: false},  // legs
    {joint: [0.1, 0.9, 0], radius: 0.08, length: 0.7, isUp: false},
    {joint: [-0.24, 1.4, 0], radius: 0.06, length: 0.5, isUp: false},  // arms
    {joint: [0.24, 1.4, 0], radius: 0.06, length: 0.5, isUp: false},
] as const;

/** Of the parts: how far they swing at a stride, radians. */
const kSwing = [0, 0, 0.6, -0.6, -0.5, 0.5];

export class Figure {
    readonly mesh: three.SkinnedMesh;
    private readonly bones: three.Bone[];

    constructor(color: three.ColorRepresentation) {
        const geometry = mergeGeometries(kParts.map(({joint, radius, length, isUp}, i) => {
            const part = new three.CapsuleGeometry(radius, length, 6, 16);
            part.translate(joint[0], joint[1] + (isUp ? 0.5 : -0.5) * (length + radius), joint[2]);
            const count = part.attributes.position.count;
            part.setAttribute('skinIndex', new three.Uint16BufferAttribute(new Uint16Array(4 * count).fill(i), 4));
            const weights = new Float32Array(4 * count).map((_, k) => k % 4 === 0 ? 1 : 0);
            part.setAttribute('skinWeight', new three.Float32BufferAttribute(weights, 4));
            return part;
        }));
        this.mesh = new three.SkinnedMesh(geometry, new three.MeshStandardMaterial({color, roughness: 0.8}));
        this.mesh.castShadow = this.mesh.receiveShadow = true;
        this.bones = kParts.map(({joint}) => {
            const bone = new three.Bone();
            bone.position.fromArray(joint);
            this.mesh.add(bone);
            return bone;
        });
        this.mesh.updateMatrixWorld();
        this.mesh.bind(new three.Skeleton(this.bones));
    }

    /** After a way of `distance` metres. */
    walk(distance: number): void {
        this.bones.forEach((bone, i) => { bone.rotation.x = kSwing[i] * Math.sin(4 * distance); });
    }
}
