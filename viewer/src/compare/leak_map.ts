// SPDX-License-Identifier: Apache-2.0
// Balls at the places of a leak check, colored by their share of light; they are visible through walls.
import * as three from 'three';

import {kHeatMap, Rgb} from '../page/color_maps';
import {leakHeat} from './leak_check';

const kGrey: Rgb = [0.6, 0.6, 0.6];
const kSelected: Rgb = [0.2, 1, 1];

export class LeakMap {
    readonly group = new three.Group();
    private places: readonly (readonly number[])[] = [];
    private shares: readonly number[] = [];
    private radius = 0.1;
    private selected = -1;

    show(places: readonly (readonly number[])[], shares: readonly number[], radius: number): void {
        this.places = places;
        this.shares = shares;
        this.radius = radius;
        this.selected = -1;
        this.draw();
    }

    select(place: number): void {
        this.selected = place;
        this.draw();
    }

    clear(): void {
        this.show([], [], 1);
    }

    private draw(): void {
        for (const mesh of this.group.children as three.InstancedMesh[]) {
            mesh.dispose();
            (mesh.material as three.Material).dispose();
        }
        this.group.clear();
        if (this.places.length === 0) return;
        const common = {toneMapped: false};
        const materials = [new three.MeshBasicMaterial(common),
                           new three.MeshBasicMaterial({...common, depthFunc: three.GreaterDepth, depthWrite: false,
                                                        transparent: true, opacity: 0.3})];
        for (const material of materials) this.group.add(this.balls(material));
    }

    private balls(material: three.Material): three.InstancedMesh {
        const mesh = new three.InstancedMesh(kBall, material, this.places.length);
        const matrix = new three.Matrix4();
        const color = new three.Color();
        this.places.forEach((place, i) => {
            const heat = leakHeat(this.shares[i]);
            const rgb = i === this.selected ? kSelected : heat > 0 ? kHeatMap.color(heat) : kGrey;
            const size = this.radius * (i === this.selected ? 1 : heat > 0 ? 0.7 + heat : 0.4);
            matrix.makeScale(size, size, size).setPosition(place[0], place[1], place[2]);
            mesh.setMatrixAt(i, matrix);
            mesh.setColorAt(i, color.setRGB(...rgb, three.SRGBColorSpace));
        });
        mesh.frustumCulled = false;
        mesh.renderOrder = 5;
        return mesh;
    }
}

const kBall = new three.IcosahedronGeometry(1, 2);
