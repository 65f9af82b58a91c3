// SPDX-License-Identifier: Apache-2.0
import * as three from 'three';
import {expect, test} from 'vitest';

import {ShadowChanges} from '../../src/view/shadow_changes';

test('shadows are old if what casts them has moved, or others cast them', () => {
    const caster = new three.Mesh(new three.BoxGeometry());
    const other = new three.Mesh(new three.BoxGeometry());
    caster.castShadow = true;
    const scene = new three.Scene();
    scene.add(caster, other);
    const changes = new ShadowChanges();
    expect(changes.follow(scene)).toBe('others');
    expect(changes.follow(scene)).toBe('none');
    other.position.x = 1;  // casts no shadow
    expect(changes.follow(scene)).toBe('none');
    caster.position.x = 1;
    expect(changes.follow(scene)).toBe('moved');
    caster.visible = false;
    expect(changes.follow(scene)).toBe('others');
});
