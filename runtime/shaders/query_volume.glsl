// SPDX-License-Identifier: Apache-2.0
// What a query on the GPU reads: the arrays of ShaderVolume (runtime/shader_volume.h), which has
// the layout. GLSL 4.50: storage buffers at TETRALIGHT_FIRST_BUFFER ..+4 and the uniform block at
// TETRALIGHT_VOLUME_BINDING. Textures: 2048 texels wide, RGBA32F and RGBA32UI.

struct TetralightVolumeFacts {
    vec4 origin;
    vec4 origin_rest;
    vec4 axis;
    vec4 seed_low;
    vec4 seed_scale;
    uvec4 seed_size;
    uvec4 counts;
    PackedSh ambient;
};

#if defined(TETRALIGHT_CPP)
// The twin has these as members (runtime/shader_query.cpp).
#elif defined(TETRALIGHT_HLSL)
cbuffer TetralightVolume {
    TetralightVolumeFacts tetralight_volume;
};
StructuredBuffer<vec4> tetralight_positions;
StructuredBuffer<vec4> tetralight_light;
StructuredBuffer<uvec4> tetralight_cells;
StructuredBuffer<vec4> tetralight_hull_rays;
StructuredBuffer<uvec4> tetralight_seeds;
#elif defined(TETRALIGHT_TEXTURES)
layout(std140) uniform TetralightVolume {
    TetralightVolumeFacts tetralight_volume;
};
uniform highp sampler2D tetralight_positions;
uniform highp sampler2D tetralight_light;
uniform highp usampler2D tetralight_cells;
uniform highp sampler2D tetralight_hull_rays;
uniform highp usampler2D tetralight_seeds;
#else
#ifndef TETRALIGHT_VOLUME_BINDING
#define TETRALIGHT_VOLUME_BINDING 0
#endif
#ifndef TETRALIGHT_FIRST_BUFFER
#define TETRALIGHT_FIRST_BUFFER 0
#endif
layout(std140, binding = TETRALIGHT_VOLUME_BINDING) uniform TetralightVolume {
    TetralightVolumeFacts tetralight_volume;
};
layout(std430, binding = TETRALIGHT_FIRST_BUFFER) readonly buffer TetralightPositions {
    vec4 tetralight_positions[];
};
layout(std430, binding = TETRALIGHT_FIRST_BUFFER + 1) readonly buffer TetralightLight {
    vec4 tetralight_light[];
};
layout(std430, binding = TETRALIGHT_FIRST_BUFFER + 2) readonly buffer TetralightCells {
    uvec4 tetralight_cells[];
};
layout(std430, binding = TETRALIGHT_FIRST_BUFFER + 3) readonly buffer TetralightHullRays {
    vec4 tetralight_hull_rays[];
};
layout(std430, binding = TETRALIGHT_FIRST_BUFFER + 4) readonly buffer TetralightSeeds {
    uvec4 tetralight_seeds[];
};
#endif

#if defined(TETRALIGHT_TEXTURES)
#define TETRALIGHT_AT(array, index) \
    texelFetch(array, ivec2(int((index) & 2047u), int((index) >> 11u)), 0)
#else
#define TETRALIGHT_AT(array, index) array[index]
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

// Part 0..6 of a probe's PackedSh; 7: its occlusion.
vec4 tetralight_probe_light(uint probe, uint part) {
    return TETRALIGHT_AT(tetralight_light, 8u * probe + part);
}

// A cell near a local position: that of the seed grid's voxel around it.
uint tetralight_seed_cell(vec3 local) {
    vec4 low = tetralight_volume.seed_low;
    vec4 scale = tetralight_volume.seed_scale;
    uvec4 size = tetralight_volume.seed_size;
    uint x = uint(clamp((local.x - low.x) * scale.x, 0.0f, float(size.x - 1u)));
    uint y = uint(clamp((local.y - low.y) * scale.y, 0.0f, float(size.y - 1u)));
    uint z = uint(clamp((local.z - low.z) * scale.z, 0.0f, float(size.z - 1u)));
    uint voxel = x + size.x * (y + size.y * z);
    uvec4 four = TETRALIGHT_AT(tetralight_seeds, voxel >> 2u);
    uint place = voxel & 3u;
    return place < 2u ? (place == 0u ? four.x : four.y) : (place == 2u ? four.z : four.w);
}
