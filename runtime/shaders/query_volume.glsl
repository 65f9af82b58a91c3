// SPDX-License-Identifier: Apache-2.0
// The data of queries on the GPU: the arrays of ShaderVolume (runtime/shader_volume.h). Buffers use
// the bindings below, in HLSL the registers t0 to t4 and b5; all six differ, as Vulkan requires. To
// use other bindings define all six before this file. Textures are 2048 texels wide, RGBA32F and
// RGBA32UI, and are bound by name.
#ifndef TETRALIGHT_VOLUME_BINDING
#define TETRALIGHT_POSITIONS_BINDING 0
#define TETRALIGHT_LIGHT_BINDING 1
#define TETRALIGHT_CELLS_BINDING 2
#define TETRALIGHT_HULL_RAYS_BINDING 3
#define TETRALIGHT_SEEDS_BINDING 4
#define TETRALIGHT_VOLUME_BINDING 5
#endif

struct TetralightVolumeConstants {
    vec4 origin;
    vec4 origin_rest;
    vec4 axis;
    vec4 seed_min;
    vec4 seed_scale;
    uvec4 seed_size;
    uvec4 counts;
    TetralightPackedSh ambient;
};

#if defined(TETRALIGHT_CPP)
// Members of the C++ twin (runtime/shader_query.cpp).
#elif defined(TETRALIGHT_HLSL)
#define TETRALIGHT_JOIN(kind, number) kind##number
#define TETRALIGHT_REGISTER(kind, number) register(TETRALIGHT_JOIN(kind, number))
cbuffer TetralightVolume : TETRALIGHT_REGISTER(b, TETRALIGHT_VOLUME_BINDING) {
    TetralightVolumeConstants tetralight_volume;
};
StructuredBuffer<vec4> tetralight_positions : TETRALIGHT_REGISTER(t, TETRALIGHT_POSITIONS_BINDING);
StructuredBuffer<vec4> tetralight_light : TETRALIGHT_REGISTER(t, TETRALIGHT_LIGHT_BINDING);
StructuredBuffer<uvec4> tetralight_cells : TETRALIGHT_REGISTER(t, TETRALIGHT_CELLS_BINDING);
StructuredBuffer<vec4> tetralight_hull_rays : TETRALIGHT_REGISTER(t, TETRALIGHT_HULL_RAYS_BINDING);
StructuredBuffer<uvec4> tetralight_seeds : TETRALIGHT_REGISTER(t, TETRALIGHT_SEEDS_BINDING);
#elif defined(TETRALIGHT_TEXTURES)
layout(std140) uniform TetralightVolume {
    TetralightVolumeConstants tetralight_volume;
};
uniform highp sampler2D tetralight_positions;
uniform highp sampler2D tetralight_light;
uniform highp usampler2D tetralight_cells;
uniform highp sampler2D tetralight_hull_rays;
uniform highp usampler2D tetralight_seeds;
#else
layout(std140, binding = TETRALIGHT_VOLUME_BINDING) uniform TetralightVolume {
    TetralightVolumeConstants tetralight_volume;
};
layout(std430, binding = TETRALIGHT_POSITIONS_BINDING) readonly buffer TetralightPositions {
    vec4 tetralight_positions[];
};
layout(std430, binding = TETRALIGHT_LIGHT_BINDING) readonly buffer TetralightLight {
    vec4 tetralight_light[];
};
layout(std430, binding = TETRALIGHT_CELLS_BINDING) readonly buffer TetralightCells {
    uvec4 tetralight_cells[];
};
layout(std430, binding = TETRALIGHT_HULL_RAYS_BINDING) readonly buffer TetralightHullRays {
    vec4 tetralight_hull_rays[];
};
layout(std430, binding = TETRALIGHT_SEEDS_BINDING) readonly buffer TetralightSeeds {
    uvec4 tetralight_seeds[];
};
#endif

#if defined(TETRALIGHT_TEXTURES)
#define TETRALIGHT_AT(a, i) texelFetch(a, ivec2(int((i) & 2047u), int((i) >> 11u)), 0)
#else
#define TETRALIGHT_AT(a, i) a[i]
#endif

vec3 tetralight_probe_position(uint probe) {
    vec4 position = TETRALIGHT_AT(tetralight_positions, probe);
    return vec3(position.x, position.y, position.z);
}

vec3 tetralight_hull_ray(uint cell, uint corner) {
    uint hull_cell = cell - tetralight_volume.counts.z;
    vec4 ray = TETRALIGHT_AT(tetralight_hull_rays, 3u * hull_cell + corner);
    return vec3(ray.x, ray.y, ray.z);
}

uvec4 tetralight_cell_vertices(uint cell) {
    return TETRALIGHT_AT(tetralight_cells, 2u * cell);
}

uvec4 tetralight_cell_neighbors(uint cell) {
    return TETRALIGHT_AT(tetralight_cells, 2u * cell + 1u);
}

// Part 0..6 of a probe's TetralightPackedSh; 7: its occlusion.
vec4 tetralight_probe_light(uint probe, uint part) {
    return TETRALIGHT_AT(tetralight_light, 8u * probe + part);
}

// A cell near a local position: the cell at the center of its voxel in the seed grid.
uint tetralight_seed_cell(vec3 local) {
    vec4 lower = tetralight_volume.seed_min;
    vec4 scale = tetralight_volume.seed_scale;
    uvec4 size = tetralight_volume.seed_size;
    uint x = uint(clamp((local.x - lower.x) * scale.x, 0.0f, float(size.x - 1u)));
    uint y = uint(clamp((local.y - lower.y) * scale.y, 0.0f, float(size.y - 1u)));
    uint z = uint(clamp((local.z - lower.z) * scale.z, 0.0f, float(size.z - 1u)));
    uint voxel = x + size.x * (y + size.y * z);
    uvec4 four = TETRALIGHT_AT(tetralight_seeds, voxel >> 2u);
    uint place = voxel & 3u;
    return place < 2u ? (place == 0u ? four.x : four.y) : (place == 2u ? four.z : four.w);
}
