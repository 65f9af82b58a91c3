// SPDX-License-Identifier: Apache-2.0
// Reflection probes on objects of three.js:
//
//     const reflections = new SceneReflections(readReflections(buffer));
//     reflections.add(gltf.scene);
//     each frame: reflections.update();
import * as three from 'three';

import {argumentError} from '../error.js';
import {changedWeights, LayerWeights} from '../layers.js';
import type {ReflectionProbe, Reflections} from '../reflections.js';
import {kCoefficients} from '../sh.js';
import {kMostCubes, mirrorCopy, ReflectionUniforms, setProbe} from './reflection_shader.js';

type Mesh = three.Mesh<three.BufferGeometry, three.Material | three.Material[]>;

const kLargestHalf = 65504;

interface MirrorMesh {
    before: three.Material | three.Material[];
    uniforms: ReflectionUniforms;
    /** Where the mesh was when its probes were chosen. */
    matrixWorld: three.Matrix4;
}

/**
 * The cube of a probe with its levels: radiance for a roughness r at level r (2 - r) (levels - 1). Shaders sample it with
 * directions in world axes. As an environment three.js would show it mirrored, and blur it again.
 */
export function reflectionCube(reflections: Reflections, probe: number): three.CubeTexture {
    return makeCube(reflections, level => reflections.texels(probe, level));
}

/** `texels`: those of all faces of a level. */
function makeCube({size, levelCount}: Reflections, texels: (level: number) => Uint16Array): three.CubeTexture {
    const faces = (level: number) => {
        const side = size >> level;
        const all = texels(level);
        const each = 4 * side * side;
        return Array.from({length: 6}, (_, face) => new three.DataTexture(
            all.slice(face * each, (face + 1) * each), side, side, three.RGBAFormat, three.HalfFloatType));
    };
    const cube = new three.CubeTexture(faces(0), undefined, undefined, undefined, three.LinearFilter,
        levelCount > 1 ? three.LinearMipmapLinearFilter : three.LinearFilter, three.RGBAFormat, three.HalfFloatType);
    cube.colorSpace = three.NoColorSpace;
    cube.generateMipmaps = false;
    // three.js takes level 0 from the images, and the others from here.
    const smaller = Array.from({length: levelCount - 1}, (_, i) => ({image: faces(i + 1)}));
    cube.mipmaps = smaller as unknown as typeof cube.mipmaps;
    cube.needsUpdate = true;
    return cube;
}

/** Lets meshes with standard and physical materials mirror the probes around them, in WebGLRenderer. */
export class SceneReflections {
    private readonly cubes: three.CubeTexture[];
    /** With the irradiance of the weights of now. */
    private readonly probes: ReflectionProbe[];
    private readonly meshes = new Map<Mesh, MirrorMesh>();
    /** Probes in the order in which they cover each other. */
    private readonly order: number[];

    constructor(private readonly reflections: Reflections) {
        this.cubes = reflections.probes.map((_, probe) => reflectionCube(reflections, probe));
        this.probes = reflections.probes.map(probe => ({...probe}));
        this.order = coveringOrder(reflections.probes);
    }

    /** Meshes get copies of their materials, which `remove` takes away. */
    add(object: three.Object3D): void {
        object.traverse(child => {
            const mesh = child as Mesh;
            if (!mesh.isMesh || this.meshes.has(mesh)) return;
            const uniforms: ReflectionUniforms = {
                cubes: [], probes: new Float32Array(4 * 6 * kMostCubes), sh: new Float32Array(28 * kMostCubes),
                count: {value: 0}, lastLevel: this.reflections.levelCount - 1,
            };
            const mirror = {before: mesh.material, uniforms, matrixWorld: new three.Matrix4().copy(mesh.matrixWorld)};
            this.choose(mesh, uniforms);
            this.meshes.set(mesh, mirror);
            const copies = [mesh.material].flat().map(material =>
                'isMeshStandardMaterial' in material ? mirrorCopy(material, uniforms) : material);
            mesh.material = Array.isArray(mesh.material) ? copies : copies[0];
        });
    }

    remove(object: three.Object3D): void {
        object.traverse(child => {
            const mesh = child as Mesh;
            const mirror = this.meshes.get(mesh);
            if (!mirror) return;
            const before = [mirror.before].flat();
            for (const material of [mesh.material].flat()) if (!before.includes(material)) material.dispose();
            mesh.material = mirror.before;
            this.meshes.delete(mesh);
        });
    }

    /** Chooses the probes of what moved. World matrices must be those of the frame. */
    update(): void {
        for (const [mesh, {uniforms, matrixWorld}] of this.meshes) {
            if (matrixWorld.equals(mesh.matrixWorld)) continue;
            matrixWorld.copy(mesh.matrixWorld);
            this.choose(mesh, uniforms);
        }
    }

    /** Changes the weights of layers of the bake; those that are not named are as they were baked. */
    setWeights(weights: LayerWeights): void {
        const {layers} = this.reflections;
        if (layers.length === 0) throw argumentError('weights', 'change nothing: the reflection probes hold no layers');
        const changed = changedWeights(layers.map(layer => layer.name), layers.map(layer => layer.weight), weights);
        this.probes.forEach((probe, i) => {
            this.cubes[i].dispose();
            this.cubes[i] = makeCube(this.reflections, level => this.weighted(i, level, changed));
            probe.sh = this.weightedSh(i, changed);
        });
        for (const [mesh, {uniforms}] of this.meshes) this.choose(mesh, uniforms);
    }

    private weighted(probe: number, level: number, weights: readonly number[]): Uint16Array {
        const {reflections} = this;
        const halves = reflections.texels(probe, level).slice();
        const parts = weights.map((_, layer) => reflections.texels(probe, level, layer));
        for (let i = 0; i < halves.length; ++i) {
            if (i % 4 === 3) continue;  // not light
            let sum = 0;
            for (let k = 0; k < parts.length; ++k) sum += weights[k] * three.DataUtils.fromHalfFloat(parts[k][i]);
            halves[i] = three.DataUtils.toHalfFloat(Math.min(sum, kLargestHalf));
        }
        return halves;
    }

    private weightedSh(probe: number, weights: readonly number[]): Float32Array {
        const {layerIrradiance} = this.reflections;
        const sum = new Float32Array(kCoefficients);
        weights.forEach((weight, k) => {
            const from = kCoefficients * (probe * weights.length + k);
            for (let i = 0; i < kCoefficients; ++i) sum[i] += weight * layerIrradiance[from + i];
        });
        return sum;
    }

    dispose(): void {
        for (const mesh of [...this.meshes.keys()]) this.remove(mesh);
        for (const cube of this.cubes) cube.dispose();
    }

    /** The probes that are everywhere, then those with the nearest boxes. */
    private choose(mesh: Mesh, uniforms: ReflectionUniforms): void {
        const {probes} = this;
        const bounds = new three.Box3().setFromObject(mesh);
        const distances = probes.map(probe => distanceTo(probe, bounds));
        const nearest = new Set([...this.order].sort((a, b) => distances[a] - distances[b]).slice(0, kMostCubes));
        const chosen = this.order.filter(probe => nearest.has(probe));
        uniforms.count.value = chosen.length;
        for (let k = 0; k < kMostCubes; ++k) {
            uniforms.cubes[k] = this.cubes[chosen[k] ?? chosen[0]];
            if (k < chosen.length) setProbe(uniforms, k, probes[chosen[k]]);
        }
    }
}

/** Importance, then small boxes first, then their order in the file. */
function coveringOrder(probes: readonly ReflectionProbe[]): number[] {
    const volumes = probes.map(({halfSize: [x, y, z]}) => x * y * z);
    const compare = (a: number, b: number) => a < b ? -1 : Number(a > b);  // of infinities, too
    return probes.map((_, i) => i).sort((a, b) =>
        probes[b].importance - probes[a].importance || compare(volumes[a], volumes[b]) || a - b);
}

/** From where a probe counts to a world box; -1 if it counts everywhere. */
function distanceTo({position, boxCenter, halfSize, axes, blendDistance}: ReflectionProbe, bounds: three.Box3): number {
    if (!Number.isFinite(halfSize[0])) return -1;
    const reach = [0, 1, 2].map(world => blendDistance + 1.001 * [0, 1, 2].reduce(
        (sum, axis) => sum + Math.abs(axes[3 * axis + world]) * halfSize[axis], 0));
    const gaps = [0, 1, 2].map(world => {
        const middle = position[world] + boxCenter[world];
        return Math.max(0, middle - reach[world] - bounds.max.getComponent(world),
                        bounds.min.getComponent(world) - middle - reach[world]);
    });
    return Math.hypot(...gaps);
}
