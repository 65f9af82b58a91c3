// SPDX-License-Identifier: Apache-2.0
// Adds the light of probes to Babylon's PBR and standard materials.
import {MaterialPluginBase} from '@babylonjs/core/Materials/materialPluginBase.js';
import type {Material} from '@babylonjs/core/Materials/material.js';
import type {UniformBuffer} from '@babylonjs/core/Materials/uniformBuffer.js';

import {kPacked} from '../sh.js';

const kVectors = [0, 1, 2, 3, 4, 5, 6].map(i => `tetralightSh${i}`);
const [kRed, kGreen, kBlue, kRed2, kGreen2, kBlue2, kLast] = kVectors;

/** Radiance of a white diffuse surface. */
const kFunction = `
vec3 tetralightRadiance(vec3 n) {
    vec4 linear = vec4(n, 1.0);
    vec4 quadratic = vec4(n.x * n.y, n.y * n.z, n.z * n.z, n.z * n.x);
    vec3 sum = vec3(dot(${kRed}, linear) + dot(${kRed2}, quadratic), dot(${kGreen}, linear) + dot(${kGreen2}, quadratic),
                    dot(${kBlue}, linear) + dot(${kBlue2}, quadratic)) + ${kLast}.rgb * (n.x * n.x - n.y * n.y);
    return max(sum, vec3(0.0));
}
`;

// In PBR materials albedo is that of the diffuse part, and finalAmbient is added to the color.
const kAddPbr = `
#ifndef UNLIT
    finalAmbient += surfaceAlbedo.rgb * aoOut.ambientOcclusionColor * tetralightRadiance(normalW);
#endif
`;

export class ProbePlugin extends MaterialPluginBase {
    /** Seven vec4, as `packSh` makes them, for normals of the scene. */
    readonly packed = new Float32Array(kPacked);

    constructor(material: Material) {
        // After the plugins that change normals.
        super(material, 'TetralightProbes', 300, {}, true, true);
        this.doNotSerialize = true;
    }

    override getClassName(): string {
        return 'TetralightProbePlugin';
    }

    override getUniforms(): {ubo: {name: string; size: number; type: string}[]; fragment: string} {
        return {ubo: kVectors.map(name => ({name, size: 4, type: 'vec4'})),
                fragment: kVectors.map(name => `uniform vec4 ${name};`).join('\n')};
    }

    override bindForSubMesh(uniforms: UniformBuffer): void {
        const {packed} = this;
        kVectors.forEach((name, i) =>
            uniforms.updateFloat4(name, packed[4 * i], packed[4 * i + 1], packed[4 * i + 2], packed[4 * i + 3]));
    }

    override getCustomCode(shaderType: string): Record<string, string> | null {
        if (shaderType !== 'fragment') return null;
        return {
            CUSTOM_FRAGMENT_DEFINITIONS: kFunction,
            CUSTOM_FRAGMENT_BEFORE_FINALCOLORCOMPOSITION: kAddPbr,
            // Where standard materials begin to sum light.
            '!vec3 diffuseBase=vec3\\(0\\.,0\\.,0\\.\\);lightingInfo info;':
                'vec3 diffuseBase=tetralightRadiance(normalW);lightingInfo info;',
        };
    }
}
