// SPDX-License-Identifier: Apache-2.0
// The difference of luminance between two pictures of the same view, pixel by pixel.
import * as three from 'three';

import {kDifferenceMap} from '../page/color_maps';
import {ScreenPass} from '../view/screen_pass';
import {meanAndP95} from './mean_p95';

export type Unit = 'stops' | 'percent';

export interface DifferenceScale {
    unit: Unit;
    /** The difference at the ends of the color map. */
    range: number;
    /** Less luminance counts as this. */
    floor: number;
}

/** Of the sizes of differences in a picture. */
export interface DifferenceFacts {
    mean: number;
    p95: number;
}

const kColors = 256;
const kFactsWidth = 96;
const kFactsHeight = 54;

const kFragment = `
uniform sampler2D leftLight;
uniform sampler2D rightLight;
uniform sampler2D colors;
uniform float floorLight;
uniform float range;
uniform bool isPercent;
uniform bool isPlain;  // write the difference itself
varying vec2 place;
float luminance(sampler2D light) {
    return max(dot(texture2D(light, place).rgb, vec3(0.2126, 0.7152, 0.0722)), floorLight);
}
void main() {
    float ratio = luminance(rightLight) / luminance(leftLight);
    float difference = isPercent ? 100.0 * (ratio - 1.0) : log2(ratio);
    vec2 inColors = vec2(0.5 + 0.5 * clamp(difference / range, -1.0, 1.0), 0.5);
    gl_FragColor = isPlain ? vec4(difference, 0.0, 0.0, 1.0) : texture2D(colors, inColors);
}`;

export class DifferencePass {
    private readonly targets = [0, 1].map(() => new three.WebGLRenderTarget(1, 1, {type: three.FloatType}));
    private readonly facts = new three.WebGLRenderTarget(kFactsWidth, kFactsHeight,
                                                         {type: three.FloatType, depthBuffer: false});
    private readonly pass: ScreenPass;

    constructor(private readonly renderer: three.WebGLRenderer) {
        for (const {texture} of this.targets) texture.minFilter = texture.magFilter = three.NearestFilter;
        this.pass = new ScreenPass(kFragment, {
            leftLight: this.targets[0].texture, rightLight: this.targets[1].texture, colors: colorTexture(), floorLight: 1,
            range: 1, isPercent: false, isPlain: false,
        });
    }

    /** Shows how much brighter the right picture is; each function draws one of the two, without tone mapping. */
    draw(drawSides: readonly [() => void, () => void], {unit, range, floor}: DifferenceScale): void {
        const {renderer, pass: {uniforms}} = this;
        const output = renderer.getRenderTarget();
        const size = renderer.getDrawingBufferSize(new three.Vector2());
        drawSides.forEach((drawSide, i) => {
            this.targets[i].setSize(size.x, size.y);
            renderer.setRenderTarget(this.targets[i]);
            drawSide();
        });
        renderer.setRenderTarget(output);
        uniforms.floorLight.value = floor;
        uniforms.range.value = range;
        uniforms.isPercent.value = unit === 'percent';
        this.pass.draw(renderer);
    }

    /** Of what was drawn last. */
    measure(): DifferenceFacts {
        const {renderer, facts, pass: {uniforms}} = this;
        const pixels = new Float32Array(4 * kFactsWidth * kFactsHeight);
        uniforms.isPlain.value = true;
        renderer.setRenderTarget(facts);
        this.pass.draw(renderer);
        renderer.readRenderTargetPixels(facts, 0, 0, kFactsWidth, kFactsHeight, pixels);
        renderer.setRenderTarget(null);
        uniforms.isPlain.value = false;
        return factsOf(pixels.filter((_, i) => i % 4 === 0));
    }
}

export function factsOf(differences: Float32Array): DifferenceFacts {
    const [mean, p95] = meanAndP95(differences.map(Math.abs));
    return {mean, p95};
}

function colorTexture(): three.DataTexture {
    const {low, high, color} = kDifferenceMap;
    const texels = Uint8Array.from({length: 4 * kColors}, (_, at) => {
        const rgb = color(low + (high - low) * Math.floor(at / 4) / (kColors - 1));
        return at % 4 === 3 ? 255 : Math.round(255 * rgb[at % 4]);
    });
    const texture = new three.DataTexture(texels, kColors, 1);
    texture.minFilter = texture.magFilter = three.LinearFilter;
    texture.needsUpdate = true;
    return texture;
}
