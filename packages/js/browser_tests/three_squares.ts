// SPDX-License-Identifier: Apache-2.0
// What the pages of the tests draw, with either renderer of three.js: squares that face the camera, in floats, and spheres
// in 8 bits.
import * as three from 'three';

import {read, Volume} from '../src/index.js';
import {ProbeVolume} from '../src/three/index.js';

export type Kind = 'standard' | 'physical' | 'lambert' | 'phong';

/** A renderer, its materials and its probes. */
export interface Kit {
    /** Linear RGBA floats of a picture of `kSize` squared pixels. */
    readPixels(scene: three.Object3D, camera: three.Camera): Promise<Float32Array>;
    /** Draws on a canvas, as users see it. */
    draw(scene: three.Scene, camera: three.Camera, exposure: number): HTMLCanvasElement;
    makeMaterial(kind: Kind, color: three.Color): three.Material;
    makeProbes(volume: Volume): ProbeVolume;
}

export interface Square {
    position: readonly number[];
    normal: readonly number[];
}

const kAlbedo = 0.5;
const kRadius = 0.05;
export const kSize = 8;  // pixels along a side of a picture of squares
export const kSphereSize = 32;  // of a sphere

const kSquare = new three.PlaneGeometry(1, 1);
const kSphere = new three.SphereGeometry(kRadius, 80, 48);

export const vector = (v: readonly number[]) => new three.Vector3(...v as [number, number, number]);

/** A camera along a normal that sees the surroundings of a position alone. */
export function cameraAt({position, normal}: Square, halfSize = 0.01, distance = 1): three.Camera {
    const camera = new three.OrthographicCamera(-halfSize, halfSize, halfSize, -halfSize, 0.01 * distance, 2 * distance);
    camera.position.copy(vector(position)).addScaledVector(vector(normal), distance);
    camera.up.set(normal[2], normal[0], normal[1]);
    camera.lookAt(vector(position));
    camera.updateMatrixWorld();
    return camera;
}

function placeOf({position, normal}: Square): three.Matrix4 {
    const turn = new three.Quaternion().setFromUnitVectors(new three.Vector3(0, 0, 1), vector(normal));
    return new three.Matrix4().compose(vector(position), turn, new three.Vector3(1, 1, 1));
}

/** Pictures of one kit. */
export class Squares {
    constructor(private readonly kit: Kit) {}

    open(base64: string): ProbeVolume {
        return this.kit.makeProbes(read(Uint8Array.from(atob(base64), c => c.charCodeAt(0))));
    }

    /** One mesh for each square, with all others in the scene; they share one material. */
    async meshes(probes: ProbeVolume, kind: Kind, squares: readonly Square[]): Promise<number[][]> {
        const scene = new three.Scene();
        const material = this.material(kind);
        const meshes = squares.map(square => makeMesh(kSquare, material, square));
        for (const mesh of meshes) scene.add(mesh);
        scene.updateMatrixWorld();
        probes.add(scene);
        probes.update();
        const colors = [];
        for (const [i, square] of squares.entries()) {
            meshes.forEach((mesh, k) => { mesh.visible = i === k; });
            colors.push(await this.color(scene, square));
        }
        probes.remove(scene);
        if (meshes.some(mesh => mesh.material !== material)) throw new Error('the material is not that of before');
        return colors;
    }

    /** All squares as instances in one draw. */
    async instances(probes: ProbeVolume, kind: Kind, squares: readonly Square[]): Promise<number[][]> {
        return this.colorsOf(probes, makeInstances(kSquare, this.material(kind), squares), squares);
    }

    /**
     * Squares among many instances: as they are added, after the squares were exchanged, and after every other instance
     * moved. `counts`: the positions whose light was found each time.
     */
    async moving(probes: ProbeVolume, squares: readonly Square[]): Promise<{colors: number[][][]; counts: number[]}> {
        const kEach = 50;
        const mesh = new three.InstancedMesh(kSquare, this.material('lambert'), kEach * squares.length);
        const place = (i: number, square: Square) => mesh.setMatrixAt(kEach * i, placeOf(square));
        const away = new three.Matrix4().makeTranslation(0, 500, 0);
        for (let i = 0; i < mesh.count; ++i) mesh.setMatrixAt(i, away);
        squares.forEach((square, i) => place(i, square));
        mesh.frustumCulled = false;
        const scene = new three.Scene().add(mesh);
        const {volume} = probes;
        const counts: number[] = [];
        const batch = volume.batch.bind(volume);
        volume.batch = (positions, ...others) => {
            counts.push(positions.length / 3);
            batch(positions, ...others);
        };
        const show = async () => {
            mesh.instanceMatrix.needsUpdate = true;
            probes.update();
            const colors = [];
            for (const square of squares) colors.push(await this.color(scene, square));
            return colors;
        };
        probes.add(scene);
        const colors = [await show()];
        squares.forEach((square, i) => place((i + 1) % squares.length, square));
        colors.push(await show());
        for (let i = 1; i < mesh.count; i += 2) mesh.setMatrixAt(i, away.makeTranslation(0, 500, i));
        colors.push(await show());
        probes.update();
        probes.remove(scene);
        return {colors, counts};
    }

    /** All squares as instances of a batch, after others were deleted. */
    async batch(probes: ProbeVolume, kind: Kind, squares: readonly Square[]): Promise<number[][]> {
        const mesh = new three.BatchedMesh(2 * squares.length, 8, 12, this.material(kind));
        const geometry = mesh.addGeometry(kSquare);
        const instances = squares.flatMap(square => [square, square].map(each => {
            const instance = mesh.addInstance(geometry);
            mesh.setMatrixAt(instance, placeOf(each));
            return instance;
        }));
        instances.forEach((instance, i) => { if (i % 2 === 0) mesh.deleteInstance(instance); });
        return this.colorsOf(probes, mesh, squares);
    }

    /** A square of which the mesh moves all corners, or, with an anchor, a bone in it. */
    async skin(probes: ProbeVolume, kind: Kind, squares: readonly Square[], isAnchored = false): Promise<number[][]> {
        const mesh = makeSkin(this.material(kind));
        const moved = isAnchored ? mesh.skeleton.bones[0] : mesh;
        const scene = new three.Scene().add(mesh);
        mesh.frustumCulled = false;
        probes.add(scene, isAnchored ? moved : undefined);
        const colors = [];
        for (const square of squares) {
            placeOf(square).decompose(moved.position, moved.quaternion, moved.scale);
            scene.updateMatrixWorld();
            probes.update();
            colors.push(await this.color(scene, square));
        }
        probes.remove(scene);
        return colors;
    }

    /** The picture of one square before and after the layers of the volume change. */
    async dim(probes: ProbeVolume, square: Square, weights: Record<string, number>): Promise<number[][]> {
        const mesh = makeMesh(kSquare, this.material('standard'), square);
        const scene = new three.Scene().add(mesh);
        scene.updateMatrixWorld();
        probes.add(scene);
        probes.update();
        const before = await this.color(scene, square);
        probes.volume.setWeights(weights);
        probes.refresh();
        const after = await this.color(scene, square);
        probes.remove(scene);
        return [before, after];
    }

    /**
     * Spheres seen along each normal: normal and 8-bit color of the pixels that they cover. With `isInstanced` they are
     * instances of one mesh.
     */
    spheres(probes: ProbeVolume, kind: Kind, places: readonly Square[], exposure: number, isInstanced: boolean): number[][][] {
        const scene = new three.Scene();
        const material = this.material(kind);
        if (isInstanced) scene.add(makeInstances(kSphere, material, places));
        else for (const place of places) scene.add(makeMesh(kSphere, material, place));
        scene.updateMatrixWorld();
        probes.add(scene);
        probes.update();
        const pixels = places.map((place, i) => {
            if (!isInstanced) scene.children.forEach((mesh, k) => { mesh.visible = i === k; });
            const camera = cameraAt(place, kRadius, 2 * kRadius);
            return readSphere(this.kit.draw(scene, camera, exposure), camera);
        });
        probes.remove(scene);
        return pixels;
    }

    private material(kind: Kind): three.Material {
        return this.kit.makeMaterial(kind, new three.Color(kAlbedo, kAlbedo, kAlbedo));
    }

    /** The color in the middle of the picture of a square, linear. */
    async color(scene: three.Scene, square: Square): Promise<number[]> {
        const pixels = await this.kit.readPixels(scene, cameraAt(square));
        return [...pixels.subarray(4 * (kSize * kSize / 2 + kSize / 2)).subarray(0, 3)];
    }

    /** The colors of squares that one object holds. */
    private async colorsOf(probes: ProbeVolume, mesh: three.Object3D, squares: readonly Square[]): Promise<number[][]> {
        const scene = new three.Scene().add(mesh);
        probes.add(scene);
        probes.update();
        const colors = [];
        for (const square of squares) colors.push(await this.color(scene, square));
        probes.remove(scene);
        return colors;
    }
}

function makeMesh(geometry: three.BufferGeometry, material: three.Material, place: Square): three.Mesh {
    const mesh = new three.Mesh(geometry, material);
    mesh.applyMatrix4(placeOf(place));
    return mesh;
}

function makeInstances(geometry: three.BufferGeometry, material: three.Material, places: readonly Square[]) {
    const mesh = new three.InstancedMesh(geometry, material, places.length);
    places.forEach((place, i) => mesh.setMatrixAt(i, placeOf(place)));
    mesh.frustumCulled = false;
    return mesh;
}

function makeSkin(material: three.Material): three.SkinnedMesh {
    const geometry = kSquare.clone();
    const count = geometry.attributes.position.count;
    geometry.setAttribute('skinIndex', new three.Uint16BufferAttribute(new Uint16Array(4 * count), 4));
    const weights = new Float32Array(4 * count).map((_, i) => i % 4 === 0 ? 1 : 0);
    geometry.setAttribute('skinWeight', new three.Float32BufferAttribute(weights, 4));
    const mesh = new three.SkinnedMesh(geometry, material);
    const bone = new three.Bone();
    mesh.add(bone);
    mesh.bind(new three.Skeleton([bone]));
    return mesh;
}

/** Of each pixel well within the sphere that fills the picture: its world normal and its color, six numbers. */
function readSphere(canvas: HTMLCanvasElement, camera: three.Camera): number[][] {
    const flat = document.createElement('canvas');
    flat.width = flat.height = kSphereSize;
    const context = flat.getContext('2d')!;
    context.drawImage(canvas, 0, 0);
    const {data} = context.getImageData(0, 0, kSphereSize, kSphereSize);
    const pixels = [];
    for (let row = 0; row < kSphereSize; ++row) {
        for (let column = 0; column < kSphereSize; ++column) {
            const x = 2 * (column + 0.5) / kSphereSize - 1;
            const y = 1 - 2 * (row + 0.5) / kSphereSize;
            if (x * x + y * y > 0.9) continue;
            const normal = new three.Vector3(x, y, Math.sqrt(1 - x * x - y * y)).transformDirection(camera.matrixWorld);
            const at = 4 * (row * kSphereSize + column);
            pixels.push([...normal.toArray(), data[at], data[at + 1], data[at + 2]]);
        }
    }
    return pixels;
}
