// SPDX-License-Identifier: Apache-2.0
// In the page: a scene with lightmaps, as three.js shows it, and how far that is from a picture of
// `tetralight render`. Only surfaces are compared that show nothing but their lightmap and one
// colour: opaque, without texture and emission. They are made Lambert's, as the bake takes them.
import * as three from 'three';
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';
import {LightmapLoader} from '/examples/threejs/lightmap_loader.js';

const isPlain = ({lightMap, map, transparent, alphaTest, emissive}) =>
    lightMap && !map && !transparent && alphaTest === 0 && emissive.getHex() === 0;

/** Its colour is 0.96 · base (1 − metallic) + F0 · roughness / 2, as docs/conventions.md has it. */
function lambertOf({color: base, metalness, roughness, lightMap, lightMapIntensity, side}) {
    const f0 = new three.Color().setScalar(0.04).lerp(base, metalness);
    const color = base.clone().multiplyScalar(0.96 * (1 - metalness)).add(f0.multiplyScalar(roughness / 2));
    return new three.MeshLambertMaterial({color, lightMap, lightMapIntensity, side});
}

/** Of plain meshes in the picture of surfaces; smaller numbers are of nothing and of other meshes. */
const kFirst = 2;

/** Shows the normal and a number. */
function surfaceMaterial(number, side) {
    return new three.ShaderMaterial({
        side,
        uniforms: {number: {value: number}},
        vertexShader: 'varying vec3 shown; void main() { shown = normal; ' +
            'gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }',
        fragmentShader: 'uniform float number; varying vec3 shown; void main() { gl_FragColor = vec4(shown, number); }',
    });
}

/** True if two pixels show the same smooth surface. */
function isSame(surfaces, i, k) {
    const [a, b] = [i, k].map(pixel => surfaces.subarray(4 * pixel, 4 * pixel + 4));
    return a[3] === b[3] && Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) < 0.2;
}

export class LightmapPicture {
    /** `settings`: scene, camera, width, height, and halves or nothing. */
    static async open(settings) {
        const loader = new GLTFLoader();
        loader.register(parser => new LightmapLoader(parser, {halves: settings.halves}));
        return new LightmapPicture(await loader.loadAsync(settings.scene), settings);
    }

    constructor({scene, cameras}, {camera, width, height}) {
        this.scene = new three.Scene().add(scene);
        this.lights = [];
        this.plain = [];
        this.other = [];
        scene.traverse(object => {
            if (object.isLight && object.visible) this.lights.push(object.name);
            if (object.isPoints) object.visible = false;  // probes
            if (object.isMesh) (isPlain(object.material) ? this.plain : this.other).push(object);
        });
        for (const mesh of this.plain) mesh.material = lambertOf(mesh.material);
        const black = new three.MeshBasicMaterial({color: 0, side: three.DoubleSide});
        for (const mesh of this.other) mesh.material = black;
        this.camera = cameras.find(({name}) => name === camera);
        this.camera.aspect = width / height;
        this.camera.updateProjectionMatrix();
        this.renderer = new three.WebGLRenderer({antialias: false});
        this.renderer.setSize(width, height);
        this.renderer.toneMapping = three.NeutralToneMapping;
    }

    /** Radiance, four floats a pixel from the lower left. */
    radiance() {
        const {width, height} = this.renderer.domElement;
        const target = new three.WebGLRenderTarget(width, height, {type: three.FloatType});
        this.renderer.setRenderTarget(target);
        this.renderer.render(this.scene, this.camera);
        const pixels = new Float32Array(4 * width * height);
        this.renderer.readRenderTargetPixels(target, 0, 0, width, height, pixels);
        this.renderer.setRenderTarget(null);
        target.dispose();
        return pixels;
    }

    /** Pixels that show a plain surface, and so do all eight around them: on an edge, a ray and a
        rasterizer may see either side. */
    inner() {
        const materials = this.plain.map(mesh => mesh.material);
        this.plain.forEach((mesh, i) => { mesh.material = surfaceMaterial(kFirst + i, materials[i].side); });
        const surfaces = this.radiance();
        this.plain.forEach((mesh, i) => { mesh.material = materials[i]; });
        const {width, height} = this.renderer.domElement;
        const around = [-width - 1, -width, -width + 1, -1, 1, width - 1, width, width + 1];
        const found = [];
        for (let y = 1; y + 1 < height; ++y) {
            for (let x = 1; x + 1 < width; ++x) {
                const i = y * width + x;
                if (surfaces[4 * i + 3] >= kFirst && around.every(step => isSame(surfaces, i, i + step))) found.push(i);
            }
        }
        return found;
    }

    /** The exposure at which 99 % of what is compared lie below 0.8, where tone mapping begins to compress. */
    exposure() {
        const pixels = this.radiance();
        const peaks = this.inner().map(i => Math.max(...pixels.slice(4 * i, 4 * i + 3))).sort((a, b) => a - b);
        return 0.8 / peaks[Math.floor(0.99 * peaks.length)];
    }

    /** sRGB as a canvas shows it, four bytes a pixel from the lower left. */
    shown(exposure) {
        const {width, height} = this.renderer.domElement;
        this.renderer.toneMappingExposure = exposure;
        this.renderer.render(this.scene, this.camera);
        const gl = this.renderer.getContext();
        const pixels = new Uint8Array(4 * width * height);
        gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
        return pixels;
    }

    /** How many pixels differ in their largest channel by 0, 1, 2 … of 255 from the picture at `url`. */
    async differences(exposure, url) {
        const ours = this.shown(exposure);
        const theirs = await flippedBytes(url);
        const counts = new Array(256).fill(0);
        for (const i of this.inner()) {
            ++counts[Math.max(...[0, 1, 2].map(c => Math.abs(ours[4 * i + c] - theirs[4 * i + c])))];
        }
        return counts;
    }

    /** Moves all lightmaps by this part of a page. */
    shift(distance) {
        for (const {material} of this.plain) material.lightMap.offset.addScalar(distance);
    }

    textures() {
        return this.renderer.info.memory.textures;
    }
}

async function flippedBytes(url) {
    const image = await createImageBitmap(await (await fetch(url)).blob());
    const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
    context.scale(1, -1);
    context.drawImage(image, 0, -image.height);
    return context.getImageData(0, 0, image.width, image.height).data;
}
