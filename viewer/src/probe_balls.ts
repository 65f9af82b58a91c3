// SPDX-License-Identifier: Apache-2.0
// All probes as one instanced draw of balls that show their light.
import {kCoefficients, kPacked, packSh} from 'tetralight';
import * as three from 'three';
import {mergeVertices} from 'three/addons/utils/BufferGeometryUtils.js';

import {instanceAttributes, setInstanceSh, shShader} from './shaders';

const kVertex = shShader + instanceAttributes + `
attribute vec3 center;
attribute vec4 tint;
uniform float radius;
varying vec3 light;
varying vec4 paint;
void main() {
    TetralightPackedSh sh = TetralightPackedSh(shaR, shaG, shaB, shbR, shbG, shbB, shC);
    light = max(tetralight_sample_sh9(sh, position), vec3(0.0));
    paint = tint;
    gl_Position = projectionMatrix * viewMatrix * vec4(center + radius * position, 1.0);
}`;

const kFragment = `
varying vec3 light;
varying vec4 paint;  // means the same in every exposure
void main() {
    gl_FragColor = vec4(light, 1.0);
    #include <tonemapping_fragment>
    gl_FragColor.rgb = mix(gl_FragColor.rgb, paint.rgb, paint.a);
    #include <colorspace_fragment>
}`;

const kBalls = new Map<number, three.BufferGeometry>();

/** A unit ball of shared corners; the more there are, the plainer each. */
function ballGeometry(count: number): three.BufferGeometry {
    const detail = count > 20000 ? 1 : count > 2000 ? 3 : 6;
    if (!kBalls.has(detail)) kBalls.set(detail, makeBall(detail));
    return kBalls.get(detail)!;
}

function makeBall(detail: number): three.BufferGeometry {
    const ball = new three.IcosahedronGeometry(1, detail);
    ball.deleteAttribute('normal');
    ball.deleteAttribute('uv');
    return mergeVertices(ball);
}

export class ProbeBalls {
    readonly mesh: three.Mesh<three.InstancedBufferGeometry, three.ShaderMaterial>;
    readonly count: number;
    private readonly packed: three.InstancedInterleavedBuffer;
    private readonly tint: three.InstancedBufferAttribute;

    constructor(readonly positions: Float32Array, radius: number) {
        this.count = positions.length / 3;
        const ball = ballGeometry(this.count);
        const geometry = new three.InstancedBufferGeometry();
        geometry.index = ball.index;
        geometry.setAttribute('position', ball.getAttribute('position'));
        geometry.setAttribute('center', new three.InstancedBufferAttribute(positions, 3));
        this.packed = setInstanceSh(geometry, new Float32Array(this.count * kPacked));
        this.tint = new three.InstancedBufferAttribute(new Float32Array(this.count * 4), 4);
        geometry.setAttribute('tint', this.tint);
        geometry.instanceCount = this.count;
        this.mesh = new three.Mesh(geometry, new three.ShaderMaterial({
            vertexShader: kVertex, fragmentShader: kFragment, uniforms: {radius: {value: radius}},
        }));
        this.mesh.frustumCulled = false;
    }

    /** 27 floats a probe; empty: black. */
    setLight(irradiance: Float32Array): void {
        const packed = this.packed.array as Float32Array;
        for (let i = 0; i < irradiance.length / kCoefficients; ++i) packSh(irradiance, i * kCoefficients, packed, i * kPacked);
        this.packed.needsUpdate = true;
    }

    /** Colours over the light: red, green, blue and how much of them. */
    setTint(tint: (probe: number) => readonly number[]): void {
        for (let i = 0; i < this.count; ++i) this.tint.array.set(tint(i), 4 * i);
        this.tint.needsUpdate = true;
    }

    set radius(radius: number) {
        this.mesh.material.uniforms.radius.value = radius;
    }

    get radius(): number {
        return this.mesh.material.uniforms.radius.value as number;
    }

    /** The nearest ball that a ray meets, or -1. */
    pick(ray: three.Ray): number {
        return pickBall(this.positions, this.radius, ray);
    }

    /** Takes them out of the picture, too. */
    dispose(): void {
        this.mesh.removeFromParent();
        this.mesh.geometry.dispose();
        this.mesh.material.dispose();
    }
}

export function pickBall(positions: ArrayLike<number>, radius: number, ray: three.Ray): number {
    const {origin: o, direction: d} = ray;
    let best = -1;
    let nearest = Infinity;
    for (let i = 0; i < positions.length / 3; ++i) {
        const x = positions[3 * i] - o.x;
        const y = positions[3 * i + 1] - o.y;
        const z = positions[3 * i + 2] - o.z;
        const along = x * d.x + y * d.y + z * d.z;
        const square = x * x + y * y + z * z - along * along;
        if (along > 0 && along < nearest && square < radius * radius) {
            nearest = along;
            best = i;
        }
    }
    return best;
}
