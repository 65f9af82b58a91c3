// SPDX-License-Identifier: Apache-2.0
// Shadow maps are drawn again only if something that casts or makes shadows has changed.
import * as three from 'three';

export class ShadowChanges {
    private casters = '';
    private places: number[] = [];

    /** 'none', 'moved', or 'others' if other objects cast or make shadows than before. */
    follow(scene: three.Scene): 'none' | 'moved' | 'others' {
        const names: string[] = [];
        const places: number[] = [];
        scene.updateMatrixWorld();
        scene.traverseVisible(object => {
            if (!object.castShadow) return;
            const {geometry, instanceMatrix} = object as Partial<three.InstancedMesh>;
            names.push(`${object.id} ${geometry?.id}`);
            places.push(...object.matrixWorld.elements, instanceMatrix?.version ?? 0);
        });
        const casters = names.join();
        const change = casters !== this.casters ? 'others' :
            places.some((place, i) => place !== this.places[i]) ? 'moved' : 'none';
        this.casters = casters;
        this.places = places;
        return change;
    }
}
