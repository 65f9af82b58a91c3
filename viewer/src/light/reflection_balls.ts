// SPDX-License-Identifier: Apache-2.0
// A perfect mirror at the place of each reflection probe: what its cube holds.
import type {Reflections} from 'tetralight';
import * as three from 'three';

const kVertex = `
varying vec3 place;
varying vec3 away;
void main() {
    vec4 world = modelMatrix * vec4(position, 1.0);
    place = world.xyz;
    away = mat3(modelMatrix) * position;  // the scale is uniform
    gl_Position = projectionMatrix * viewMatrix * world;
}`;

const kFragment = `
uniform samplerCube cube;
varying vec3 place;
varying vec3 away;
void main() {
    vec3 mirrored = reflect(normalize(place - cameraPosition), normalize(away));
    gl_FragColor = vec4(textureLod(cube, mirrored, 0.0).rgb, 1.0);
    #include <tonemapping_fragment>
    #include <colorspace_fragment>
}`;

export class ReflectionBalls {
    readonly group = new three.Group();

    constructor({probes}: Reflections, cubes: three.CubeTexture[], radius: number) {
        const ball = new three.SphereGeometry(1, 48, 32);
        probes.forEach(({position, name}, i) => {
            const mesh = new three.Mesh(ball, new three.ShaderMaterial(
                {vertexShader: kVertex, fragmentShader: kFragment, uniforms: {cube: {value: cubes[i]}}}));
            mesh.position.fromArray(position);
            mesh.scale.setScalar(radius);
            mesh.name = name;
            this.group.add(mesh);
        });
    }

    /** Takes them out of the picture, too; the cubes are not theirs. */
    dispose(): void {
        this.group.removeFromParent();
        for (const mesh of this.group.children as three.Mesh<three.BufferGeometry, three.ShaderMaterial>[]) {
            mesh.geometry.dispose();
            mesh.material.dispose();
        }
    }
}
