// SPDX-License-Identifier: Apache-2.0
// The light of probes as nodes (TSL) of three.js.
import * as three from 'three';
import {dot, drawIndex, Fn, instanceIndex, int, ivec2, max, normalWorld, textureLoad, textureSize, uniform, varying, vec3,
        vec4} from 'three/tsl';
import {IrradianceNode, Node, NodeBuilder, NodeMaterial} from 'three/webgpu';

type Vec3 = Node<'vec3'>;
type Vec4 = Node<'vec4'>;

const kVectors = [0, 1, 2, 3, 4, 5, 6];

/** The seven vec4 of `packSh` of each lit mesh. */
const lights = new WeakMap<three.Object3D, Float32Array>();

export function setMeshLight(mesh: three.Object3D, light: Float32Array): void {
    lights.set(mesh, light);
}

/** One set of uniforms for all meshes, so that meshes with equal materials share a program. */
const meshVectors: Vec4[] = kVectors.map(i => uniform(new three.Vector4()).onObjectUpdate(({object}, self) => {
    const light = object ? lights.get(object) : undefined;
    if (light) self.value.fromArray(light, 4 * i);
    return undefined;
}));

/** Irradiance on the normal of a mesh whose light `setMeshLight` set. */
export function meshIrradiance(): Vec3 {
    return irradianceOf(meshVectors);
}

/** Irradiance on the normal of an instance, whose light is in a texture: the texels of an instance follow each other. */
export function instanceIrradiance(texture: three.DataTexture): Vec3 {
    const place = Fn((_: unknown, builder: NodeBuilder) => {
        const first = int(instanceOf(builder)).mul(7);
        const width = widthOf(texture);
        return ivec2(first.mod(width), first.div(width));
    })() as unknown as Node<'ivec2'>;
    const flat = varying(place).setInterpolation(three.InterpolationSamplingType.FLAT) as Node<'ivec2'>;
    return irradianceOf(kVectors.map(i => textureLoad(texture, flat.add(ivec2(i, 0))) as Vec4));
}

const widthOf = (texture: three.Texture | undefined) =>
    int((textureSize(textureLoad(texture), int(0)) as unknown as Node<'ivec2'>).x);

/** The instance that the vertex shader draws; of a `BatchedMesh`, that of the draw. */
function instanceOf(builder: NodeBuilder): Node<'uint'> | Node<'int'> {
    const mesh = builder.object as three.Object3D & {isBatchedMesh?: true; _indirectTexture?: three.DataTexture};
    if (!mesh.isBatchedMesh) return instanceIndex;
    const hasDraws = (builder as unknown as {getDrawIndex(): string | null}).getDrawIndex() !== null;
    const draw = int(hasDraws ? drawIndex : instanceIndex);
    const width = widthOf(mesh._indirectTexture);
    return int(textureLoad(mesh._indirectTexture, ivec2(draw.mod(width), draw.div(width))).x);
}

function irradianceOf(vectors: readonly Vec4[]): Vec3 {
    const n = normalWorld;
    const linear = vec4(n, 1);
    const quadratic = vec4(n.x.mul(n.y), n.y.mul(n.z), n.z.mul(n.z), n.z.mul(n.x));
    const channel = (i: number) => dot(vectors[i], linear).add(dot(vectors[i + 3], quadratic));
    const last = vectors[6].xyz.mul(n.x.mul(n.x).sub(n.y.mul(n.y)));
    return max(vec3(channel(0), channel(1), channel(2)).add(last).mul(Math.PI), vec3(0)) as Vec3;
}

/** Adds irradiance to what the lights of the scene and the lightmap of a material give. */
export function addIrradiance(material: NodeMaterial, irradiance: Vec3): void {
    const {setupLightMap} = material;
    const own = {
        setupLightMap(builder: NodeBuilder): Node {
            const before = setupLightMap.call(material, builder) as IrradianceNode | null;
            const sum = before?.node ? (before.node as Vec3).add(irradiance) : irradiance;
            return new IrradianceNode(sum) as unknown as Node;
        },
        // The renderer looks for changes of uniforms where a property is a node, and programs differ by them.
        probeLightNode: irradiance,
    };
    Object.assign(material, own);
}
