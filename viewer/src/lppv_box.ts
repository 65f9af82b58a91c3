// SPDX-License-Identifier: Apache-2.0
// A proxy volume to place and size: a large white block, each pixel lit from the served 3D texture.
import * as three from 'three';

import {parseLppv} from './ktx2';
import {emptyConstants, lightByLppv, LppvUniforms} from './shaders';

/** Of each edge, in metres. */
export const kLeastSize = 0.05;

export class LppvBox {
    /** Its position and scale are the box's middle and size. */
    readonly group = new three.Group();
    private readonly block: three.Mesh;
    private readonly uniforms: LppvUniforms = {
        lppv: {value: null}, lppvConstants: {value: emptyConstants()},
    };

    constructor() {
        const material = new three.MeshLambertMaterial({color: 0xffffff});
        lightByLppv(material, this.uniforms);
        this.block = new three.Mesh(new three.BoxGeometry(0.96, 0.96, 0.96), material);
        this.block.castShadow = true;
        this.block.receiveShadow = true;
        this.block.visible = false;
        const edges = new three.LineSegments(
            new three.EdgesGeometry(new three.BoxGeometry(1, 1, 1)),
            new three.LineBasicMaterial({color: 0x7fe3a0, toneMapped: false}));
        this.group.add(this.block, edges);
        this.group.scale.set(6, 1, 1);
    }

    /** What to ask the server for. */
    order(volume: string): Record<string, unknown> {
        const {position: p, scale: s} = this.group;
        const bounds = [p.x - s.x / 2, p.y - s.y / 2, p.z - s.z / 2,
                        p.x + s.x / 2, p.y + s.y / 2, p.z + s.z / 2];
        const resolution = s.toArray().map(length => Math.min(32, Math.max(2, Math.ceil(2 * length) + 1)));
        return {volume, bounds, resolution, format: 'ktx2', mode: 'full', precision: 'half'};
    }

    show(file: ArrayBuffer): void {
        const {texture, constants} = parseLppv(file);
        this.uniforms.lppv.value?.dispose();
        this.uniforms.lppv.value = texture;
        this.uniforms.lppvConstants.value = constants;
        this.block.visible = true;
    }

    clear(): void {
        this.block.visible = false;
    }
}
