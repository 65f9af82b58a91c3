// SPDX-License-Identifier: Apache-2.0
// What the examples share: they open a scene and its baked light by parameters of the address, and draw frames.
//
//     character.html?scene=uv1.glb&probes=court.probes&lightmaps=court.lightmaps
import {irradiance, kCoefficients, read, readLightmaps, Volume} from 'tetralight';
import {ProbeVolume, SceneLightmaps} from 'tetralight/three';
import * as three from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';

const parameters = new URLSearchParams(location.search);
const status = document.getElementById('status')!;

/** A number of the address. */
export function parameter(name: string, standard: number): number {
    const text = parameters.get(name);
    const value = text === null ? standard : Number(text);
    if (!Number.isFinite(value)) throw new Error(`the parameter ${name} is "${text}", not a number`);
    return value;
}

export function say(text: string): void {
    status.textContent = text;
}

export interface Stage {
    readonly volume: Volume;
    readonly probes: ProbeVolume;
    /** Of the static objects, if the address has them. */
    readonly lightmaps: SceneLightmaps | null;
    readonly scene: three.Scene;
    /** Of the probes. */
    readonly box: three.Box3;
    /** Suns and lamps of the file that are not baked as a whole. */
    readonly lights: three.Light[];
    /** Radiance of the sky that the file says. */
    readonly sky: three.Color;
    /** The height of the ground below a position, or that of the lowest probe. */
    groundBelow(position: three.Vector3): number;
    /** Draws frames; `move` gets the time in seconds. */
    run(move: (time: number) => void): void;
}

async function fetched(name: string): Promise<ArrayBuffer> {
    const url = parameters.get(name);
    if (url === null) throw new Error(`the address has no parameter "${name}": see README.md`);
    const response = await fetch(url);
    if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`);
    return response.arrayBuffer();
}

function boxOf(volume: Volume): three.Box3 {
    const box = new three.Box3();
    for (let i = 0; i < volume.probeCount; ++i) box.expandByPoint(new three.Vector3(...volume.position(i)));
    return box;
}

/** A white surface that faces up is at half of the brightness that the screen has, on average. */
function exposureOf(volume: Volume): number {
    let sum = 0;
    for (let i = 0; i < volume.probeCount; ++i) sum += irradiance(volume.irradiance, [0, 1, 0], kCoefficients * i)[1];
    return 0.5 * Math.PI * volume.probeCount / sum;
}

/** Shadows of suns in the whole box; lights that are baked as a whole are taken away. */
function prepareLights(root: three.Object3D, box: three.Box3): three.Light[] {
    const lights: three.Light[] = [];
    root.traverse(object => {
        if (object instanceof three.Points || object instanceof three.Line) object.visible = false;  // groups of probes
        if (object instanceof three.Mesh) {
            object.castShadow = object.receiveShadow = true;
            for (const material of [object.material].flat()) material.shadowSide = three.DoubleSide;  // else light leaks in
        }
        if (object instanceof three.Light) lights.push(object);
    });
    const {center, radius} = box.getBoundingSphere(new three.Sphere());
    return lights.filter(light => {
        const isBaked = ({...light.userData, ...light.parent?.userData} as {mode?: string}).mode === 'baked';
        if (isBaked) light.removeFromParent();
        if (light instanceof three.DirectionalLight) {
            const direction = light.getWorldPosition(new three.Vector3()).sub(light.target.getWorldPosition(new three.Vector3()));
            light.position.copy(light.parent!.worldToLocal(center.clone().addScaledVector(direction.normalize(), 2 * radius)));
            light.castShadow = true;
            light.shadow.mapSize.set(1024, 1024);
            light.shadow.normalBias = radius / 256;
            Object.assign(light.shadow.camera, {left: -radius, right: radius, top: radius, bottom: -radius, near: radius / 2,
                                                far: 4 * radius});
        }
        return !isBaked;
    });
}

/** The first camera of the file, or one beside the box. */
function cameraOf(cameras: three.Camera[], box: three.Box3): three.PerspectiveCamera {
    const first = cameras.find(camera => camera instanceof three.PerspectiveCamera);
    const camera = new three.PerspectiveCamera(first?.fov ?? 50, 1, 0.05, 1000);
    const center = box.getCenter(new three.Vector3());
    const size = box.getSize(new three.Vector3());
    if (first) first.matrixWorld.decompose(camera.position, camera.quaternion, camera.scale);
    else camera.position.copy(center).add(new three.Vector3(0, 0.5 * size.y + 1, 1.2 * Math.max(size.x, size.z)));
    if (!first) camera.lookAt(center);
    return camera;
}

function makeRenderer(volume: Volume): three.WebGLRenderer {
    const renderer = new three.WebGLRenderer({antialias: true});
    renderer.toneMapping = three.NeutralToneMapping;
    renderer.toneMappingExposure = parameter('exposure', exposureOf(volume));
    renderer.shadowMap.enabled = true;
    document.body.append(renderer.domElement);
    return renderer;
}

/** Draws until the page closes. With `time` in the address, time stands still. */
function drawFrames(renderer: three.WebGLRenderer, scene: three.Scene, camera: three.PerspectiveCamera, box: three.Box3,
                    before: (time: number) => void): void {
    const controls = new OrbitControls(camera, renderer.domElement);
    const distance = camera.position.distanceTo(box.getCenter(new three.Vector3()));
    controls.target.copy(camera.getWorldDirection(new three.Vector3()).multiplyScalar(distance).add(camera.position));
    const resize = () => {
        renderer.setSize(innerWidth, innerHeight);
        camera.aspect = innerWidth / innerHeight;
        camera.updateProjectionMatrix();
    };
    addEventListener('resize', resize);
    resize();
    let frames = 0;
    renderer.setAnimationLoop(now => {
        controls.update();
        before(parameter('time', now / 1000));
        renderer.render(scene, camera);
        document.body.dataset.frames = String(++frames);
    });
}

export async function openStage(): Promise<Stage> {
    const [file, probeFile] = await Promise.all([fetched('scene'), fetched('probes')]);
    const {scene: root, cameras} = await new GLTFLoader().parseAsync(file, '');
    const volume = read(probeFile);
    const box = boxOf(volume);
    const scene = new three.Scene().add(root);
    scene.updateMatrixWorld();
    const lights = prepareLights(root, box);
    const lightmaps = parameters.has('lightmaps') ? new SceneLightmaps(readLightmaps(await fetched('lightmaps')), root) : null;
    const probes = new ProbeVolume(volume);
    const placed = new Set<three.Object3D>(lightmaps?.meshes);
    const others: three.Object3D[] = [];
    root.traverse(object => { if (object instanceof three.Mesh && !placed.has(object)) others.push(object); });
    for (const object of others) if (object.children.length === 0) probes.add(object);
    const radiance = (root.userData.sky as {radiance?: [number, number, number]} | undefined)?.radiance;
    const sky = new three.Color(...(radiance ?? [0, 0, 0]));
    scene.background = sky;
    const renderer = makeRenderer(volume);
    const down = new three.Vector3(0, -1, 0);
    return {
        volume, probes, lightmaps, scene, box, lights, sky,
        groundBelow: position => new three.Raycaster(position, down).intersectObject(root)[0]?.point.y ?? box.min.y,
        run: move => drawFrames(renderer, scene, cameraOf(cameras, box), box, time => {
            move(time);
            scene.updateMatrixWorld();
            probes.update();
        }),
    };
}

/** Opens the stage and begins; errors are shown on the page. */
export function start(begin: (stage: Stage) => void): void {
    openStage().then(begin).catch((error: unknown) => {
        say(String(error));
        throw error;
    });
}
