// SPDX-License-Identifier: Apache-2.0
// What can be baked, and where it is ordered.

export type BakeKind = 'volumes' | 'lightmaps' | 'reflections';

interface BakeOrder {
    title: string;
    path: string;
    schema: string;     // of the order, in /openapi.json
    nameLabel: string;
}

export const kOrders: Record<BakeKind, BakeOrder> = {
    volumes: {title: 'Probes', path: '/v1/bakes', schema: 'BakeOrder', nameLabel: 'Name of the volume'},
    lightmaps: {title: 'Lightmaps', path: '/v1/lightmap-bakes', schema: 'LightmapBakeOrder',
                nameLabel: 'Name of the lightmaps'},
    reflections: {title: 'Reflection probes', path: '/v1/reflection-bakes', schema: 'ReflectionBakeOrder',
                  nameLabel: 'Name of the reflection probes'},
};
