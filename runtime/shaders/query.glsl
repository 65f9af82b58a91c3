// SPDX-License-Identifier: Apache-2.0
// Locates a position among the probes and blends them on the GPU: the walk and the cells of
// probes/locate.h, in floats. The C++ twin (runtime/shader_query.h) compiles this text.
//
//   // hint: the cell of the last query near by, or any number
//   TetralightCellLocation location = tetralight_locate(world_position, hint);
//   TetralightPackedProbe probe = tetralight_interpolate(location);
//   color = albedo * max(tetralight_sample_sh9(probe.sh, normal), 0.0);

TETRALIGHT_CONST uint tetralight_no_cell = 4294967295u;
// Maximum number of cells that a walk tests.
TETRALIGHT_CONST uint tetralight_walk_limit = 1024u;
// A tetrahedron whose volume is a smaller fraction of the sum of its products is a sliver, whose
// weights floats cannot compute: its positions belong to the neighboring cells.
TETRALIGHT_CONST float tetralight_sliver = 5e-5f;
TETRALIGHT_CONST float tetralight_sliver_scale = 1e-18f;
TETRALIGHT_CONST float tetralight_least_sum = 1e-15f;
// A walk between two cells accepts the better one if its measure is at least this: rounding error.
TETRALIGHT_CONST float tetralight_settled = -1e-4f;
TETRALIGHT_CONST float tetralight_outside = -1e30f;

// The cell of a position and the weights of its probes, which are >= 0 and sum to 1. The cell is
// tetralight_no_cell, and the light ambient, if there are no probes or the position is not finite.
struct TetralightCellLocation {
    uint cell;
    vec4 weights;
};

// The light at one position.
struct TetralightPackedProbe {
    TetralightPackedSh sh;
    // Four channels, 1 = lit.
    vec4 occlusion;
};

// The best cell so far; `measure` is its smallest weight divided by the sum of its weights.
struct TetralightCandidate {
    TetralightCellLocation location;
    float measure;
};

// Signed volumes, proportional to barycentric weights. Normals are computed from edges, so that the
// signs do not depend on the direction of the walk.
vec4 tetralight_tetrahedron_weights(uvec4 vertices, vec3 position) {
    vec3 p0 = tetralight_probe_position(vertices.x);
    vec3 p1 = tetralight_probe_position(vertices.y);
    vec3 p2 = tetralight_probe_position(vertices.z);
    vec3 p3 = tetralight_probe_position(vertices.w);
    vec3 a = p1 - p0;
    vec3 b = p2 - p0;
    vec3 c = p3 - p0;
    float unit = inversesqrt(max(max(dot(a, a), max(dot(b, b), dot(c, c))), 1e-36f));
    a = a * unit;
    b = b * unit;
    c = c * unit;
    vec3 r0 = (position - p0) * unit;
    vec3 r1 = (position - p1) * unit;
    vec3 bc = cross(b, c);
    vec4 weights = vec4(-dot(r1, cross((p2 - p1) * unit, (p3 - p1) * unit)), dot(r0, bc),
                        dot(r0, cross(c, a)), dot(r0, cross(a, b)));
    vec3 products = abs(vec3(b.y * c.z, b.z * c.x, b.x * c.y)) +
                    abs(vec3(b.z * c.y, b.x * c.z, b.y * c.x));
    bool is_sliver = !(dot(a, bc) > tetralight_sliver * dot(abs(a), products));
    return is_sliver ? weights * tetralight_sliver_scale : weights;
}

// For probes in a plane: signed areas along the normal of the plane.
vec4 tetralight_triangle_weights(uvec4 vertices, vec3 position) {
    vec3 axis = vec3(tetralight_volume.axis.x, tetralight_volume.axis.y, tetralight_volume.axis.z);
    vec3 p0 = tetralight_probe_position(vertices.x);
    vec3 p1 = tetralight_probe_position(vertices.y);
    vec3 p2 = tetralight_probe_position(vertices.z);
    vec3 r0 = position - p0;
    vec3 r1 = position - p1;
    vec3 r2 = position - p2;
    float square = max(dot(r0, r0), max(dot(r1, r1), dot(r2, r2)));
    float unit = inversesqrt(max(square, 1e-36f));
    return vec4(dot(axis, cross((p2 - p1) * unit, r1 * unit)),
                dot(axis, cross((p0 - p2) * unit, r2 * unit)),
                dot(axis, cross((p1 - p0) * unit, r0 * unit)), 0.0f);
}

// For probes on a line: signed distances.
vec4 tetralight_segment_weights(uvec4 vertices, vec3 position) {
    vec3 axis = vec3(tetralight_volume.axis.x, tetralight_volume.axis.y, tetralight_volume.axis.z);
    vec3 r0 = position - tetralight_probe_position(vertices.x);
    vec3 r1 = position - tetralight_probe_position(vertices.y);
    float along0 = dot(r0, axis);
    float along1 = dot(r1, axis);
    float unit = 1.0f / max(max(abs(along0), abs(along1)), 1e-36f);
    return vec4(-along1 * unit, along0 * unit, 0.0f, 0.0f);
}

// Not normalized. If a weight is negative, the position lies outside the face opposite its vertex.
vec4 tetralight_cell_weights(uint cell, vec3 position) {
    uvec4 vertices = tetralight_cell_vertices(cell);
    uint dimension = tetralight_volume.counts.w;
    if (cell < tetralight_volume.counts.z) {
        if (dimension == 4u) return tetralight_tetrahedron_weights(vertices, position);
        if (dimension == 3u) return tetralight_triangle_weights(vertices, position);
        if (dimension == 2u) return tetralight_segment_weights(vertices, position);
        return vec4(1.0f, 0.0f, 0.0f, 0.0f);
    }
    if (dimension == 4u) return tetralight_hull_triangle_weights(cell, vertices, position);
    if (dimension == 3u) return tetralight_hull_edge_weights(cell, vertices, position);
    return tetralight_hull_end_weights(cell, vertices, position);
}

// The smallest weight divided by the sum of weights: >= 0 inside the cell.
float tetralight_inside_measure(vec4 weights) {
    float sum = (weights.x + weights.z) + (weights.y + weights.w);
    if (!(sum > tetralight_least_sum)) return tetralight_outside;
    return min(min(weights.x, weights.y), min(weights.z, weights.w)) / sum;
}

// The neighbor across the face of the most negative weight.
uint tetralight_next_cell(uint cell, vec4 weights) {
    uvec4 neighbors = tetralight_cell_neighbors(cell);
    uint next = neighbors.x;
    float lowest = weights.x;
    if (weights.y < lowest) {
        lowest = weights.y;
        next = neighbors.y;
    }
    if (weights.z < lowest) {
        lowest = weights.z;
        next = neighbors.z;
    }
    return weights.w < lowest ? neighbors.w : next;
}

TetralightCandidate tetralight_better(TetralightCandidate best, uint cell, vec4 weights) {
    float measure = tetralight_inside_measure(weights);
    if (measure > best.measure) {
        best.measure = measure;
        best.location.cell = cell;
        best.location.weights = weights;
    }
    return best;
}

// Tests the neighbors of a cell and their neighbors, after a walk that ended in a cycle or between
// two cells.
TetralightCandidate tetralight_search_near(TetralightCandidate best, uint cell, vec3 position) {
    uvec4 around = tetralight_cell_neighbors(cell);
    for (int i = 0; i < 4 && best.measure < 0.0f; ++i) {
        uint first = around[i];
        if (first >= tetralight_volume.counts.y) continue;
        best = tetralight_better(best, first, tetralight_cell_weights(first, position));
        uvec4 beyond = tetralight_cell_neighbors(first);
        for (int j = 0; j < 4 && best.measure < 0.0f; ++j) {
            uint second = beyond[j];
            if (second >= tetralight_volume.counts.y || second == cell) continue;
            best = tetralight_better(best, second, tetralight_cell_weights(second, position));
        }
    }
    return best;
}

TetralightCandidate tetralight_walk(uint start, vec3 position) {
    TetralightCandidate best;
    best.location.cell = tetralight_no_cell;
    best.location.weights = vec4(0.0f, 0.0f, 0.0f, 0.0f);
    best.measure = 2.0f * tetralight_outside;
    uint cell = start;
    uint previous = tetralight_no_cell;
    for (uint i = 0u; i < tetralight_walk_limit; ++i) {
        vec4 weights = tetralight_cell_weights(cell, position);
        best = tetralight_better(best, cell, weights);
        if (best.measure >= 0.0f) return best;
        uint next = tetralight_next_cell(cell, weights);
        if (next >= tetralight_volume.counts.y) break;
        if (next == previous) break;
        previous = cell;
        cell = next;
    }
    if (best.measure >= tetralight_settled) return best;
    return tetralight_search_near(best, cell, position);
}

// Relative to the volume's origin, whose two parts keep what one float would lose. Far away only
// the direction matters.
vec3 tetralight_local_position(vec3 position) {
    vec4 origin = tetralight_volume.origin;
    vec4 rest = tetralight_volume.origin_rest;
    vec3 local = (position - vec3(origin.x, origin.y, origin.z)) - vec3(rest.x, rest.y, rest.z);
    float farthest = 65536.0f * origin.w;
    float largest = max(abs(local.x), max(abs(local.y), abs(local.z)));
    if (!(largest > 0.5f * farthest) || !(farthest > 0.0f)) return local;
    vec3 direction = local / largest;
    float size = sqrt(dot(direction, direction));
    return size * largest > farthest ? direction * (farthest / size) : local;
}

// True up to 3e38. Tests the bits, because drivers may compile comparisons as if NaN did not exist.
bool tetralight_is_finite(float x) {
    return (floatBitsToUint(x) & 0x7fffffffu) <= 0x7f61b1e6u;
}

// Finds the cell that contains a world position, and the weights of its probes. `hint` is the cell
// of a query near by, or any number that is not the index of a cell.
TetralightCellLocation tetralight_locate(vec3 position, uint hint) {
    TetralightCellLocation location;
    location.cell = tetralight_no_cell;
    location.weights = vec4(0.0f, 0.0f, 0.0f, 0.0f);
    uint cell_count = tetralight_volume.counts.y;
    if (cell_count == 0u || !tetralight_is_finite(position.x) ||
        !tetralight_is_finite(position.y) || !tetralight_is_finite(position.z)) {
        return location;
    }
    vec3 local = tetralight_local_position(position);
    uint start = hint < cell_count ? hint : tetralight_seed_cell(local);
    TetralightCandidate found = tetralight_walk(start, local);
    if (!(found.measure > tetralight_outside)) return location;
    vec4 clamped = max(found.location.weights, location.weights);
    location.cell = found.location.cell;
    location.weights = clamped / ((clamped.x + clamped.z) + (clamped.y + clamped.w));
    return location;
}

// As in probes/receiver.h.
TETRALIGHT_CONST float tetralight_normal_offset = 0.1f;

// The place that the weights of a location stand for, relative to the volume's origin.
vec3 tetralight_weighted_place(TetralightCellLocation location) {
    uvec4 vertices = tetralight_cell_vertices(location.cell);
    vec3 place = vec3(0.0f, 0.0f, 0.0f);
    for (int i = 0; i < 4; ++i) {
        float weight = location.weights[i];
        uint probe = vertices[i];
        if (weight > 0.0f) place = place + tetralight_probe_position(probe) * weight;
    }
    return place;
}

// The mean distance, metres, from a position to the probes of its cell, by its weights.
float tetralight_mean_probe_distance(TetralightCellLocation location) {
    float mean = 0.0f;
    if (location.cell >= tetralight_volume.counts.y) return mean;
    vec3 place = tetralight_weighted_place(location);
    uvec4 vertices = tetralight_cell_vertices(location.cell);
    for (int i = 0; i < 4; ++i) {
        float weight = location.weights[i];
        uint probe = vertices[i];
        if (!(weight > 0.0f)) continue;
        vec3 away = tetralight_probe_position(probe) - place;
        mean += weight * sqrt(dot(away, away));
    }
    return mean;
}

// A position on a surface moved off along its unit normal, so that a wall takes the light of its
// own side. `location` is that of the position; normal_offset is the share of the mean distance to
// the probes.
vec3 tetralight_push_off_surface(vec3 position, vec3 normal, TetralightCellLocation location,
                                 float normal_offset) {
    return position + normal * (normal_offset * tetralight_mean_probe_distance(location));
}

TetralightPackedSh tetralight_add_probe(TetralightPackedSh sum, uint probe, float weight) {
    sum.sha_r = sum.sha_r + tetralight_probe_light(probe, 0u) * weight;
    sum.sha_g = sum.sha_g + tetralight_probe_light(probe, 1u) * weight;
    sum.sha_b = sum.sha_b + tetralight_probe_light(probe, 2u) * weight;
    sum.shb_r = sum.shb_r + tetralight_probe_light(probe, 3u) * weight;
    sum.shb_g = sum.shb_g + tetralight_probe_light(probe, 4u) * weight;
    sum.shb_b = sum.shb_b + tetralight_probe_light(probe, 5u) * weight;
    sum.shc = sum.shc + tetralight_probe_light(probe, 6u) * weight;
    return sum;
}

// The location with weights that know the walls of the volume.
TetralightCellLocation tetralight_visible_location(TetralightCellLocation location) {
    uint place = tetralight_find_walls(location.cell);
    if (place == tetralight_no_walls) return location;
    uvec4 codes = TETRALIGHT_AT(tetralight_walls, place);
    location.weights = tetralight_visible_weights(codes, location.weights);
    return location;
}

// Blends the probes of a cell with weights as they are: for queries that ignore walls.
TetralightPackedProbe tetralight_blend(TetralightCellLocation location) {
    TetralightPackedProbe blend;
    blend.sh = tetralight_volume.ambient;
    blend.occlusion = vec4(1.0f, 1.0f, 1.0f, 1.0f);
    if (location.cell >= tetralight_volume.counts.y) return blend;
    vec4 zero = vec4(0.0f, 0.0f, 0.0f, 0.0f);
    blend.sh.sha_r = zero;
    blend.sh.sha_g = zero;
    blend.sh.sha_b = zero;
    blend.sh.shb_r = zero;
    blend.sh.shb_g = zero;
    blend.sh.shb_b = zero;
    blend.sh.shc = zero;
    blend.occlusion = zero;
    uvec4 vertices = tetralight_cell_vertices(location.cell);
    for (int i = 0; i < 4; ++i) {
        float weight = location.weights[i];
        uint probe = vertices[i];
        if (!(weight > 0.0f)) continue;
        blend.sh = tetralight_add_probe(blend.sh, probe, weight);
        blend.occlusion = blend.occlusion + tetralight_probe_light(probe, 7u) * weight;
    }
    return blend;
}

// Blends the probes of a located cell that no wall hides from the position.
TetralightPackedProbe tetralight_interpolate(TetralightCellLocation location) {
    return tetralight_blend(tetralight_visible_location(location));
}
