// SPDX-License-Identifier: Apache-2.0
// The data of queries on the GPU: the arrays of ShaderVolume (runtime/shader_volume.h). Buffers use
// the bindings below, in HLSL the registers t0 to t5 and b6; all seven differ, as Vulkan requires.
// To use other bindings define all seven before this file. Textures are 2048 texels wide, RGBA32F
// and RGBA32UI, and are bound by name.
#ifndef TETRALIGHT_VOLUME_BINDING
#define TETRALIGHT_POSITIONS_BINDING 0
#define TETRALIGHT_LIGHT_BINDING 1
#define TETRALIGHT_CELLS_BINDING 2
#define TETRALIGHT_HULL_RAYS_BINDING 3
#define TETRALIGHT_SEEDS_BINDING 4
#define TETRALIGHT_WALLS_BINDING 5
#define TETRALIGHT_VOLUME_BINDING 6
#endif

struct TetralightVolumeConstants {
    vec4 origin;
    vec4 origin_rest;
    vec4 axis;
    vec4 seed_min;
    vec4 seed_scale;
    uvec4 seed_size;
    uvec4 counts;
    uvec4 walls;
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
StructuredBuffer<uvec4> tetralight_walls : TETRALIGHT_REGISTER(t, TETRALIGHT_WALLS_BINDING);
#elif defined(TETRALIGHT_TEXTURES)
layout(std140) uniform TetralightVolume {
    TetralightVolumeConstants tetralight_volume;
};
uniform highp sampler2D tetralight_positions;
uniform highp sampler2D tetralight_light;
uniform highp usampler2D tetralight_cells;
uniform highp sampler2D tetralight_hull_rays;
uniform highp usampler2D tetralight_seeds;
uniform highp usampler2D tetralight_walls;
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
layout(std430, binding = TETRALIGHT_WALLS_BINDING) readonly buffer TetralightWalls {
    uvec4 tetralight_walls[];
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

// As in probes/seed_grid.h.
TETRALIGHT_CONST uint tetralight_finer_grid = 2147483648u;
TETRALIGHT_CONST uint tetralight_seed_header_words = 10u;
TETRALIGHT_CONST int tetralight_seed_levels = 4;
TETRALIGHT_CONST uint tetralight_seed_longest_side = 1048576u;

// A word of the seed grid. Precondition: place < seed_size.w.
uint tetralight_seed_word(uint place) {
    uvec4 four = TETRALIGHT_AT(tetralight_seeds, place >> 2u);
    uint part = place & 3u;
    return part < 2u ? (part == 0u ? four.x : four.y) : (part == 2u ? four.z : four.w);
}

float tetralight_seed_float(uint place) {
    return uintBitsToFloat(tetralight_seed_word(place));
}

// The voxel along one axis that is nearest to a local coordinate.
uint tetralight_seed_voxel(float coordinate, float lower, float scale, uint size) {
    float along = (coordinate - lower) * scale;
    float last = float(clamp(size, 1u, tetralight_seed_longest_side) - 1u);
    return uint(along > 0.0f ? min(along, last) : 0.0f);
}

// The place of the word for a local position in the grid at `place`.
uint tetralight_seed_place(vec3 local, uint place, vec4 lower, vec4 scale, uvec4 size) {
    uint x = tetralight_seed_voxel(local.x, lower.x, scale.x, size.x);
    uint y = tetralight_seed_voxel(local.y, lower.y, scale.y, size.y);
    uint z = tetralight_seed_voxel(local.z, lower.z, scale.z, size.z);
    return place + tetralight_seed_header_words + x + size.x * (y + size.y * z);
}

// The same with the header that is stored at `place`: lower corner, scale, size, a reserved word.
uint tetralight_finer_seed_place(vec3 local, uint place) {
    vec4 lower = vec4(tetralight_seed_float(place), tetralight_seed_float(place + 1u),
                      tetralight_seed_float(place + 2u), 0.0f);
    vec4 scale = vec4(tetralight_seed_float(place + 3u), tetralight_seed_float(place + 4u),
                      tetralight_seed_float(place + 5u), 0.0f);
    uvec4 size = uvec4(tetralight_seed_word(place + 6u), tetralight_seed_word(place + 7u),
                       tetralight_seed_word(place + 8u), 0u);
    return tetralight_seed_place(local, place, lower, scale, size);
}

// A cell near a local position, from the outermost grid or a finer one that its voxel names. Words
// may be corrupt: the cell exists, and no word beyond the last is read.
uint tetralight_seed_cell(vec3 local) {
    uint count = tetralight_volume.seed_size.w;
    uint place = tetralight_seed_place(local, 0u, tetralight_volume.seed_min,
                                       tetralight_volume.seed_scale, tetralight_volume.seed_size);
    uint word = place < count ? tetralight_seed_word(place) : 0u;
    for (int level = 1; level < tetralight_seed_levels && word >= tetralight_finer_grid; ++level) {
        uint finer = word - tetralight_finer_grid;
        if (finer > count - tetralight_seed_header_words) return 0u;
        place = tetralight_finer_seed_place(local, finer);
        word = place < count ? tetralight_seed_word(place) : 0u;
    }
    return word < tetralight_volume.counts.y ? word : 0u;
}
