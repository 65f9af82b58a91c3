// SPDX-License-Identifier: Apache-2.0
// Lights scenes of `tetralight export --scene` with their lightmaps. A plugin of GLTFLoader:
//
//     const loader = new GLTFLoader();
//     loader.register(parser => new LightmapLoader(parser));
//     const {scene} = await loader.loadAsync('lit.glb');
//
// three.js adds `lightMap` to the irradiance of a surface, as the lightmaps are meant.
import {Color, DataTexture, DataUtils, HalfFloatType, LinearFilter, RGBAFormat} from 'three';
import {read as readKtx2} from 'three/addons/libs/ktx-parse.module.js';

export class LightmapLoader {
    name = 'MX_lightmap';

    /** With `halves`, the address of the .ktx2 file that `tetralight export` wrote from the same
        lightmaps, the light is taken from there instead of from the 8-bit images of the scene. */
    constructor(parser, {halves = null} = {}) {
        this.parser = parser;
        this.halves = halves;
    }

    async afterRoot({scenes}) {
        const {json, associations} = this.parser;
        const layers = this.halves && await loadHalves(this.halves);
        const pages = new Map();
        for (const [object, origin] of associations) {
            const lightmap = json.nodes?.[origin?.nodes]?.extensions?.MX_lightmap;
            if (!lightmap) continue;
            const {index} = lightmap.lightMapTexture;
            if (!pages.has(index)) pages.set(index, layers ? this.layerOf(layers, index) : await this.loadRgbm(index));
            for (const mesh of this.meshesOf(object)) lightMesh(mesh, lightmap, pages.get(index));
        }
        for (const scene of scenes) scene.traverse(hideBakedLight);
    }

    /** The mesh of a node without the meshes of its children: the node itself unless it also has a camera or a light. */
    meshesOf(node) {
        if (node.isMesh) return [node];
        return node.children.filter(child => child.isMesh && this.parser.associations.get(child)?.nodes === undefined);
    }

    /** Pages are the textures of the scene that are marked as RGBM, in their order. */
    layerOf(layers, texture) {
        const first = this.parser.json.textures.findIndex(({extensions}) => extensions?.MX_texture_rgbm);
        const layer = layers[texture - first];
        if (!layer) throw new Error(`${this.halves} has ${layers.length} pages, but the scene needs page ${texture - first}`);
        return layer;
    }

    async loadRgbm(texture) {
        const page = await this.parser.getDependency('texture', texture);
        if (!page) throw new Error(`the image of lightmap texture ${texture} cannot be read`);
        const {width, height} = page.image;
        return pageTexture(halvesFromRgbm(bytesOf(page.image)), width, height);
    }
}

/** Each mesh gets a material of its own, since its rectangle of the page is its own. The page is uploaded once. */
function lightMesh(mesh, {lightMapTexture, scale, offset, intensity}, page) {
    const lightMap = page.clone();
    lightMap.channel = lightMapTexture.texCoord;
    lightMap.repeat.fromArray(scale);
    lightMap.offset.fromArray(offset);
    mesh.material = mesh.material.clone();
    mesh.material.lightMap = lightMap;
    mesh.material.lightMapIntensity = page.userData.scale ?? intensity;
}

/** Lightmaps hold all light of a baked light. */
function hideBakedLight(object) {
    if (!object.isLight) return;
    const {mode} = {...object.parent?.userData, ...object.userData};
    if (mode === 'baked') object.visible = false;
}

function pageTexture(halves, width, height) {
    const texture = new DataTexture(halves, width, height, RGBAFormat, HalfFloatType);
    texture.minFilter = texture.magFilter = LinearFilter;
    return texture;
}

/** One texture a page. */
async function loadHalves(url) {
    const answer = await fetch(url);
    if (!answer.ok) throw new Error(`${url}: ${answer.status} ${answer.statusText}`);
    try {
        return layersOf(readKtx2(new Uint8Array(await answer.arrayBuffer())));
    } catch (error) {
        throw new Error(`${url}: ${error.message}`);
    }
}

function layersOf({vkFormat, pixelWidth, pixelHeight, layerCount, levels, keyValue}) {
    const kRgba16Float = 97;
    if (vkFormat !== kRgba16Float) throw new Error(`texels have the format ${vkFormat}, not ${kRgba16Float} (RGBA16F)`);
    if (!keyValue.tetralight) throw new Error('there is no scale under the key "tetralight"');
    const {scale} = JSON.parse(new TextDecoder().decode(keyValue.tetralight).replace('\0', ''));
    const {buffer, byteOffset} = levels[0].levelData;
    const length = 4 * pixelWidth * pixelHeight;
    return Array.from({length: Math.max(1, layerCount)}, (_, layer) => {
        const halves = new Uint16Array(buffer, byteOffset + 2 * length * layer, length);
        const page = pageTexture(halves, pixelWidth, pixelHeight);
        page.userData.scale = scale;
        return page;
    });
}

/** Irradiance / intensity as half floats. RGBM is decoded before it is filtered: between decoded
    texels the GPU then interpolates the light itself. */
function halvesFromRgbm(bytes) {
    const kRange = 34.49;
    const kExponent = 2.2;
    const factors = Float32Array.from({length: 256}, (_, code) => kRange * (code / 255) ** kExponent);
    const linear = Float32Array.from({length: 256}, (_, code) => new Color().setScalar(code / 255).convertSRGBToLinear().r);
    const halves = new Uint16Array(bytes.length);
    for (let i = 0; i < bytes.length; i += 4) {
        const factor = factors[bytes[i + 3]];
        for (let c = i; c < i + 3; ++c) halves[c] = DataUtils.toHalfFloat(factor * linear[bytes[c]]);
    }
    return halves;
}

/** The bytes of an image. A 2D canvas would multiply them by alpha and round. */
function bytesOf(image) {
    const gl = new OffscreenCanvas(1, 1).getContext('webgl2');
    gl.pixelStorei(gl.UNPACK_COLORSPACE_CONVERSION_WEBGL, gl.NONE);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, image);
    gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, gl.getParameter(gl.TEXTURE_BINDING_2D), 0);
    const bytes = new Uint8Array(4 * image.width * image.height);
    gl.readPixels(0, 0, image.width, image.height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    gl.getExtension('WEBGL_lose_context')?.loseContext();
    return bytes;
}
