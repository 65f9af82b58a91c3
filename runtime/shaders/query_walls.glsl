// SPDX-License-Identifier: Apache-2.0
// Walls between probes on the GPU: the weights of probes/edge_visibility.h, with the same float
// operations in the same order. A volume that knows no walls keeps its weights to the bit.

// As in probes/edge_visibility.h.
TETRALIGHT_CONST float tetralight_unknown_edge = 67.0f;
TETRALIGHT_CONST float tetralight_edge_code_unit = 1.0f / 896.0f;
TETRALIGHT_CONST float tetralight_hidden_share = 0.01f;
TETRALIGHT_CONST float tetralight_visibility_ramp = 0.03f;
TETRALIGHT_CONST float tetralight_least_weight = 1.17549435e-38f;

TETRALIGHT_CONST uint tetralight_no_walls = 4294967295u;

// The number of bits that are set. GLSL ES 3.00 has no function for it.
uint tetralight_bit_count(uint bits) {
    uint pairs = bits - ((bits >> 1u) & 0x55555555u);
    uint fours = (pairs & 0x33333333u) + ((pairs >> 2u) & 0x33333333u);
    return (((fours + (fours >> 4u)) & 0x0f0f0f0fu) * 0x01010101u) >> 24u;
}

// The place of a cell's codes in tetralight_walls; tetralight_no_walls: all corners see all of it.
// Blocks may be corrupt: no element beyond the last is read.
uint tetralight_find_walls(uint cell) {
    uint block = cell >> 5u;
    if (block >= tetralight_volume.walls.x) return tetralight_no_walls;
    uvec4 two = TETRALIGHT_AT(tetralight_walls, block >> 1u);
    bool is_second = (block & 1u) == 1u;
    uint cells = is_second ? two.w : two.y;
    uint bit = 1u << (cell & 31u);
    if ((cells & bit) == 0u) return tetralight_no_walls;
    uint element = (is_second ? two.z : two.x) + tetralight_bit_count(cells & (bit - 1u));
    if (element >= tetralight_volume.walls.z) return tetralight_no_walls;
    return tetralight_volume.walls.y + element;
}

// r - 1 of the four codes in a word, one of each corner.
vec4 tetralight_edge_excess(uint codes) {
    vec4 steps = vec4(float(codes & 255u), float((codes >> 8u) & 255u),
                      float((codes >> 16u) & 255u), float(codes >> 24u)) -
                 tetralight_unknown_edge;
    return (steps * abs(steps)) * tetralight_edge_code_unit;
}

// How far corners are hidden whose L is 1 + `beyond`.
vec4 tetralight_hidden_part(vec4 beyond) {
    vec4 one = vec4(1.0f, 1.0f, 1.0f, 1.0f);
    vec4 t = min(beyond * (1.0f / tetralight_visibility_ramp), one);
    return (t * t) * (3.0f - 2.0f * t);
}

float tetralight_sum(vec4 v) {
    return (v.x + v.y) + (v.z + v.w);
}

// What L of corners has beyond the largest sum of one wall. `first` to `third` are the parts of
// their three edges; bits 4 k + i of `splits` say for corner i which two of them different walls
// block: 0 and 1, 0 and 2, 1 and 2.
vec4 tetralight_other_walls(uint splits, vec4 first, vec4 second, vec4 third) {
    vec4 others = vec4(0.0f, 0.0f, 0.0f, 0.0f);
    if (splits == 0u) return others;
    for (int i = 0; i < 4; ++i) {
        uint bits = splits >> uint(i);
        if ((bits & 0x111u) == 0u) continue;
        float a = max(first[i], 0.0f);
        float b = max(second[i], 0.0f);
        float c = max(third[i], 0.0f);
        float least = min(a + b, min(a + c, b + c));
        if ((bits & 0x100u) == 0u) least = min(least, a);
        if ((bits & 0x010u) == 0u) least = min(least, b);
        if ((bits & 0x001u) == 0u) least = min(least, c);
        others[i] = least;
    }
    return others;
}

// Weights that know the walls inside a cell, from its three words of codes and its splits.
vec4 tetralight_visible_weights(uvec4 codes, vec4 weights) {
    float sum = tetralight_sum(weights);
    float unit = 1.0f / max(sum, tetralight_least_weight);
    vec4 to_next = vec4(weights.y, weights.z, weights.w, weights.x);
    vec4 to_second = vec4(weights.z, weights.w, weights.x, weights.y);
    vec4 to_third = vec4(weights.w, weights.x, weights.y, weights.z);
    vec4 first = to_next * tetralight_edge_excess(codes.x);
    vec4 second = to_second * tetralight_edge_excess(codes.y);
    vec4 third = to_third * tetralight_edge_excess(codes.z);
    vec4 others = tetralight_other_walls(codes.w, to_next + first, to_second + second,
                                         to_third + third);
    vec4 sums = (((first + second) + third) - weights) - others;
    vec4 beyond = max(sums * unit, vec4(0.0f, 0.0f, 0.0f, 0.0f));
    vec4 part = tetralight_hidden_part(beyond);
    vec4 ratio = 1.0f + beyond;
    vec4 square = 1.0f / (ratio * ratio);
    vec4 fourth = square * square;
    vec4 hidden = weights * part;
    vec4 steep = hidden * (fourth * fourth);
    float share = (tetralight_hidden_share * tetralight_sum(hidden * square)) /
                  max(tetralight_sum(steep), tetralight_least_weight);
    vec4 visible = weights * (1.0f - part) + steep * share;
    return visible * (sum / max(tetralight_sum(visible), tetralight_least_weight));
}
