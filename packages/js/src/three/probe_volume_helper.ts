// SPDX-License-Identifier: Apache-2.0
// Shows the probes of a volume as balls with their light, and its cells as lines, in WebGLRenderer.
import * as three from 'three';

import {kNone} from '../section_file.js';
import {kCoefficients, kPacked, packSh} from '../sh.js';
import type {Volume} from '../volume.js';
import type {VolumeData} from '../volume_data.js';
import {irradianceFunction, kFindTexels} from './light_shader.js';
import {PackedTexture} from './packed_texture.js';

export interface ProbeVolumeHelperOptions {
    /** Of the balls, metres. A twelfth of the mean edge of the cells by default. */
    radius?: number;
    /** Of the lines. */
    color?: three.ColorRepresentation;
}

const kVertex = `#include <common>
${kFindTexels}${irradianceFunction(i => `texelFetch(tetralightTexture, tetralightPlace() + ivec2(${i}, 0), 0)`)}
varying vec3 vLight;
void main() {
    vLight = tetralightIrradiance(normalize(mat3(modelMatrix) * normal)) * RECIPROCAL_PI;
    gl_Position = projectionMatrix * modelViewMatrix * instanceMatrix * vec4(position, 1.0);
}`;

const kFragment = `
varying vec3 vLight;
void main() {
    gl_FragColor = vec4(vLight, 1.0);
    #include <tonemapping_fragment>
    #include <colorspace_fragment>
}`;

/** Balls are as bright as white diffuse surfaces that the light of the scene does not reach. */
export class ProbeVolumeHelper extends three.Object3D {
    readonly probes: three.InstancedMesh<three.BufferGeometry, three.ShaderMaterial>;
    readonly cells: three.LineSegments<three.BufferGeometry, three.LineBasicMaterial>;
    private readonly light = new PackedTexture();

    constructor(readonly volume: Volume, options: ProbeVolumeHelperOptions = {}) {
        super();
        const {positions, info: {origin}} = volume.data;
        const ends = edgesOf(volume.data);
        this.light.resize(volume.probeCount);
        this.probes = makeBalls(positions, options.radius ?? meanLength(positions, ends) / 12, this.light.texture);
        this.cells = makeLines(positions, ends, options.color ?? 0x6fa8ff);
        for (const part of [this.probes, this.cells]) {
            part.position.fromArray(origin);
            this.add(part);
        }
        this.update();
    }

    /** Shows the light of now: after `Volume.setWeights`. */
    update(): void {
        const {irradiance} = this.volume;
        const packed = new Float32Array(kPacked);
        for (let i = 0; i < irradiance.length / kCoefficients; ++i) {
            packSh(irradiance, i * kCoefficients, packed, 0);
            this.light.set(i, packed, 0);
        }
        this.light.uploadAll();
    }

    dispose(): void {
        this.light.texture.dispose();
        this.probes.dispose();
        for (const part of [this.probes, this.cells]) {
            part.geometry.dispose();
            part.material.dispose();
        }
    }
}

/** The two probes of each edge of the cells between probes, once. */
function edgesOf({cells, info: {innerCellCount}, positions}: VolumeData): Uint32Array {
    const probeCount = positions.length / 3;
    const edges = new Set<number>();
    for (let cell = 0; cell < innerCellCount; ++cell) {
        for (let i = 0; i < 4; ++i) {
            for (let k = i + 1; k < 4; ++k) {
                const [a, b] = [cells[8 * cell + i], cells[8 * cell + k]];
                if (a !== kNone && b !== kNone) edges.add(Math.min(a, b) * probeCount + Math.max(a, b));
            }
        }
    }
    const ends = new Uint32Array(2 * edges.size);
    let at = 0;
    for (const edge of edges) {
        ends[at++] = Math.floor(edge / probeCount);
        ends[at++] = edge % probeCount;
    }
    return ends;
}

/** 1 m without edges. */
function meanLength(positions: Float32Array, ends: Uint32Array): number {
    let sum = 0;
    for (let i = 0; i < ends.length; i += 2) {
        const [a, b] = [3 * ends[i], 3 * ends[i + 1]];
        sum += Math.hypot(positions[a] - positions[b], positions[a + 1] - positions[b + 1],
                          positions[a + 2] - positions[b + 2]);
    }
    return ends.length > 0 ? sum / (ends.length / 2) : 1;
}

function makeBalls(positions: Float32Array, radius: number, texture: three.Texture) {
    const count = positions.length / 3;
    const ball = new three.IcosahedronGeometry(radius, count > 20_000 ? 1 : 3);
    const material = new three.ShaderMaterial({
        vertexShader: kVertex, fragmentShader: kFragment, uniforms: {tetralightTexture: {value: texture}}});
    const balls = new three.InstancedMesh(ball, material, count);
    const matrix = new three.Matrix4();
    for (let i = 0; i < count; ++i) {
        balls.setMatrixAt(i, matrix.makeTranslation(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]));
    }
    return balls;
}

function makeLines(positions: Float32Array, ends: Uint32Array, color: three.ColorRepresentation) {
    const geometry = new three.BufferGeometry();
    geometry.setAttribute('position', new three.BufferAttribute(positions, 3));
    geometry.setIndex(new three.BufferAttribute(ends, 1));
    const material = new three.LineBasicMaterial({color, transparent: true, opacity: 0.35, toneMapped: false});
    return new three.LineSegments(geometry, material);
}
