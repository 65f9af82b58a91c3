// SPDX-License-Identifier: Apache-2.0
// All probes as one draw of balls that show their light.
import {kCoefficients, kPacked, packSh} from 'tetralight';
import * as three from 'three';

import {kY0} from './radiometry';
import {instanceAttributes, kInstanceSh, setInstanceSh, shShader} from './shaders';

/** Of the radius: probes of the selected cell. */
const kChosenSize = 1.25;
/** Of the square around a ball, for its soft edge. */
const kMargin = 1.1;
/** The largest radius of a ball in the picture. Of its distance: about a thirtieth of the picture's height. */
const kLargest = 0.03;

/** A square that faces the eye, around what the eye sees of a ball: four corners a ball instead of hundreds. */
const kVertex = instanceAttributes + `
attribute vec3 center;
attribute vec4 tint;
uniform float radius;
uniform ivec4 chosen;
uniform float otherSize;
uniform float largest;
${kInstanceSh.map(name => `flat varying vec4 ${name}OfBall;`).join('\n')}
flat varying vec4 paint;
flat varying mat3 worldFromDisc;
varying vec2 onDisc;
void main() {
    ${kInstanceSh.map(name => `${name}OfBall = ${name};`).join('\n    ')}
    paint = tint;
    float size = radius * (any(equal(chosen, ivec4(gl_InstanceID))) ? ${kChosenSize} : otherSize);
    vec3 toEye = cameraPosition - center;
    size = min(size, largest * length(toEye));
    float distance = max(length(toEye), 1.001 * size);
    vec3 outward = toEye / distance;
    vec3 right = normalize(cross(vec3(viewMatrix[0][1], viewMatrix[1][1], viewMatrix[2][1]), outward));
    worldFromDisc = mat3(right, cross(outward, right), outward);
    onDisc = ${kMargin} * position.xy;
    float sine = size / distance;
    vec3 place = center + size * (worldFromDisc * vec3(sqrt(1.0 - sine * sine) * onDisc, sine));
    gl_Position = projectionMatrix * viewMatrix * vec4(place, 1.0);
}`;

/** The ball as from far away, which balls this small look like from nearly everywhere. */
const kFragment = shShader + `
${kInstanceSh.map(name => `flat varying vec4 ${name}OfBall;`).join('\n')}
flat varying vec4 paint;  // means the same in every exposure
flat varying mat3 worldFromDisc;
varying vec2 onDisc;
void main() {
    float square = dot(onDisc, onDisc);
    float edge = (1.0 - sqrt(square)) / fwidth(onDisc.x) + 0.5;
    if (edge <= 0.0) discard;
    float facing = sqrt(max(0.0, 1.0 - square));
    TetralightPackedSh sh = TetralightPackedSh(${kInstanceSh.map(name => `${name}OfBall`).join(', ')});
    vec3 light = max(tetralight_sample_sh9(sh, worldFromDisc * vec3(onDisc, facing)), vec3(0.0));
    gl_FragColor = vec4(light, 1.0);
    #include <tonemapping_fragment>
    gl_FragColor.rgb = mix(gl_FragColor.rgb, paint.rgb, paint.a);
    // A white rim with a dark line on its inner side: balls of the scene have none, and it shows on any background.
    float soft = min(0.5, fwidth(facing));
    gl_FragColor.rgb = mix(vec3(0.02), gl_FragColor.rgb, smoothstep(0.62 - soft, 0.62 + soft, facing));
    gl_FragColor.rgb = mix(vec3(0.9), gl_FragColor.rgb, smoothstep(0.5 - soft, 0.5 + soft, facing));
    #include <colorspace_fragment>
    gl_FragColor.a = min(edge, 1.0);  // samples of the pixel that the ball covers
}`;

/** Of more probes than this each is one point in its mean light, which takes a tenth of the time. */
const kMostBalls = 20_000;

/** The mean of irradiance / π over all directions, of its first coefficient: Y₀ / π. */
const kMean = kY0 / Math.PI;

const kPointVertex = `
attribute vec3 light;
attribute vec4 tint;
uniform float radius;
uniform ivec4 chosen;
uniform float otherSize;
uniform float largest;
uniform float viewHeight;
varying vec3 meanLight;
varying vec4 paint;
varying float pixels;
void main() {
    meanLight = light;
    paint = tint;
    float size = radius * (any(equal(chosen, ivec4(gl_VertexID))) ? ${kChosenSize} : otherSize);
    gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.0);
    size = min(size, largest * gl_Position.w);
    pixels = size * projectionMatrix[1][1] * viewHeight / gl_Position.w;
    gl_PointSize = max(pixels, 1.0);
}`;

const kPointFragment = `
varying vec3 meanLight;
varying vec4 paint;
varying float pixels;
void main() {
    float square = dot(2.0 * gl_PointCoord - 1.0, 2.0 * gl_PointCoord - 1.0);
    if (square > 1.0 && pixels > 2.0) discard;
    gl_FragColor = vec4(meanLight, 1.0);
    #include <tonemapping_fragment>
    gl_FragColor.rgb = mix(gl_FragColor.rgb, paint.rgb, paint.a);
    if (pixels > 6.0 && square > 0.75) gl_FragColor.rgb = vec3(0.9);
    #include <colorspace_fragment>
}`;

export class ProbeBalls {
    readonly mesh: three.Mesh<three.InstancedBufferGeometry, three.ShaderMaterial> |
        three.Points<three.BufferGeometry, three.ShaderMaterial>;
    readonly count: number;
    private readonly light: three.InstancedInterleavedBuffer | three.BufferAttribute;
    private readonly tint: three.BufferAttribute;

    /** `otherSize`: of the radius, for probes that are not of the selected cell. `largest`: of the distance, the radius of
     * none is larger. */
    constructor(readonly positions: Float32Array, radius: number, private readonly otherSize = 1,
                private readonly largest = kLargest) {
        this.count = positions.length / 3;
        const uniforms = {radius: {value: radius}, otherSize: {value: otherSize}, largest: {value: largest},
                          chosen: {value: [-1, -1, -1, -1]}};
        if (this.count <= kMostBalls) {
            const geometry = squares(positions);
            this.light = setInstanceSh(geometry, new Float32Array(this.count * kPacked));
            this.tint = new three.InstancedBufferAttribute(new Float32Array(this.count * 4), 4);
            this.mesh = new three.Mesh(geometry, ballMaterial(uniforms));
        } else {
            const geometry = new three.BufferGeometry().setAttribute('position', new three.BufferAttribute(positions, 3));
            this.light = new three.BufferAttribute(new Float32Array(this.count * 3), 3);
            geometry.setAttribute('light', this.light);
            this.tint = new three.BufferAttribute(new Float32Array(this.count * 4), 4);
            this.mesh = pointsOf(geometry, uniforms);
        }
        this.mesh.geometry.setAttribute('tint', this.tint);
        this.mesh.frustumCulled = false;
        this.mesh.userData.isMark = true;
    }

    /** At most four probes are drawn larger than the others. */
    choose(probes: readonly number[]): void {
        this.mesh.material.uniforms.chosen.value = [0, 1, 2, 3].map(i => probes[i] ?? -1);
    }

    private get chosen(): number[] {
        return this.mesh.material.uniforms.chosen.value as number[];
    }

    /** The radius of one ball. */
    radiusOf(probe: number): number {
        return this.radius * (this.chosen.includes(probe) ? kChosenSize : this.otherSize);
    }

    /** 27 floats a probe; empty: black. */
    setLight(irradiance: Float32Array): void {
        const light = this.light.array as Float32Array;
        const isMean = this.count > kMostBalls;
        for (let i = 0; i < irradiance.length / kCoefficients; ++i) {
            const at = i * kCoefficients;
            if (!isMean) packSh(irradiance, at, light, i * kPacked);
            else for (let k = 0; k < 3; ++k) light[3 * i + k] = kMean * irradiance[at + k];
        }
        this.light.needsUpdate = true;
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
        const near = this.chosen.filter(probe => probe >= 0);
        const own = near.flatMap(probe => [...this.positions.subarray(3 * probe, 3 * probe + 3)]);
        const chosen = pickBall(own, kChosenSize * this.radius, ray, this.largest);
        return chosen >= 0 ? near[chosen] : pickBall(this.positions, this.otherSize * this.radius, ray, this.largest);
    }

    /** Takes them out of the picture, too. */
    dispose(): void {
        this.mesh.removeFromParent();
        this.mesh.geometry.dispose();
        this.mesh.material.dispose();
    }
}

function squares(centers: Float32Array): three.InstancedBufferGeometry {
    const square = new three.PlaneGeometry(2, 2);
    const geometry = new three.InstancedBufferGeometry();
    geometry.index = square.index;
    geometry.setAttribute('position', square.getAttribute('position'));
    geometry.setAttribute('center', new three.InstancedBufferAttribute(centers, 3));
    geometry.instanceCount = centers.length / 3;
    return geometry;
}

function ballMaterial(uniforms: Record<string, three.IUniform>): three.ShaderMaterial {
    return new three.ShaderMaterial({
        vertexShader: kVertex, fragmentShader: kFragment, uniforms,
        // The canvas stays opaque: alpha only says how many samples are covered.
        alphaToCoverage: true, blending: three.CustomBlending, blendSrc: three.OneFactor, blendDst: three.ZeroFactor,
        blendSrcAlpha: three.OneFactor, blendDstAlpha: three.OneFactor,
    });
}

function pointsOf(geometry: three.BufferGeometry,
                  uniforms: Record<string, three.IUniform>): three.Points<three.BufferGeometry, three.ShaderMaterial> {
    const viewHeight = {value: 1};
    const points = new three.Points(geometry, new three.ShaderMaterial({
        vertexShader: kPointVertex, fragmentShader: kPointFragment, uniforms: {...uniforms, viewHeight}}));
    const viewport = new three.Vector4();
    points.onBeforeRender = renderer => { viewHeight.value = renderer.getCurrentViewport(viewport).w; };
    return points;
}

/** The nearest ball that a ray meets, or -1; `largest` as above. */
export function pickBall(positions: ArrayLike<number>, radius: number, ray: three.Ray, largest = kLargest): number {
    const {origin: o, direction: d} = ray;
    let best = -1;
    let nearest = Infinity;
    for (let i = 0; i < positions.length / 3; ++i) {
        const x = positions[3 * i] - o.x;
        const y = positions[3 * i + 1] - o.y;
        const z = positions[3 * i + 2] - o.z;
        const along = x * d.x + y * d.y + z * d.z;
        const square = x * x + y * y + z * z - along * along;
        const reach = Math.min(radius, largest * along);
        if (along > 0 && along < nearest && square < reach * reach) {
            nearest = along;
            best = i;
        }
    }
    return best;
}
