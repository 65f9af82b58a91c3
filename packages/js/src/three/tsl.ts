// SPDX-License-Identifier: Apache-2.0
// Lights objects by the probes around them where WebGPURenderer draws them, by WebGPU or by WebGL 2:
//
//     import {NodeProbeVolume} from 'tetralight/three/tsl';
//     const probes = new NodeProbeVolume(read(buffer));
//
// It is used as `ProbeVolume`, whose materials WebGLRenderer draws.
import type * as three from 'three';
import {MeshLambertNodeMaterial, MeshPhongNodeMaterial, MeshPhysicalNodeMaterial, MeshStandardNodeMaterial,
        MeshToonNodeMaterial, NodeMaterial} from 'three/webgpu';

import type {LightSource} from './light_shader.js';
import {addIrradiance, instanceIrradiance, meshIrradiance, setMeshLight} from './light_nodes.js';
import {Mesh, ProbeVolume} from './probe_volume.js';

const kNodeMaterials: Record<string, new() => NodeMaterial> = {
    MeshStandardMaterial: MeshStandardNodeMaterial, MeshPhysicalMaterial: MeshPhysicalNodeMaterial,
    MeshLambertMaterial: MeshLambertNodeMaterial, MeshPhongMaterial: MeshPhongNodeMaterial,
    MeshToonMaterial: MeshToonNodeMaterial,
};

/** A `ProbeVolume` for node materials. Other materials become the node materials that WebGPURenderer draws for them. */
export class NodeProbeVolume extends ProbeVolume {
    protected override litMaterial(material: three.Material, source: LightSource, mesh: Mesh): three.Material {
        const copy = nodeCopy(material);
        if (!copy) return material;
        if ('sh' in source) setMeshLight(mesh, source.sh);
        addIrradiance(copy, 'sh' in source ? meshIrradiance() : instanceIrradiance(source.texture));
        return copy;
    }
}

/** Undefined if the material has no light. */
function nodeCopy(material: three.Material): NodeMaterial | undefined {
    if ((material as NodeMaterial).isNodeMaterial) {
        const isLit = Object.values(kNodeMaterials).some(kind => material instanceof kind);
        return isLit ? (material as NodeMaterial).clone() : undefined;
    }
    if (!(material.type in kNodeMaterials)) return undefined;
    const copy = new kNodeMaterials[material.type]();
    // As WebGPURenderer does it; `copy` of the material would take its type, too.
    for (const [name, value] of Object.entries(material)) {
        if (!['uuid', 'type', 'version'].includes(name)) (copy as unknown as Record<string, unknown>)[name] = value;
    }
    return copy;
}
