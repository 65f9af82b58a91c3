// SPDX-License-Identifier: Apache-2.0
// Weights in the cells outside of the hull: the one triangle (p_i + t v_i), t >= 0, whose plane
// holds the position first (Cupisz, GDC 2012), as probes/detail/hull_cell.cpp has it. Differences
// of probes are taken before anything else, so that floats are exact enough far from the hull, too.

TETRALIGHT_CONST float tetralight_farthest_root = 1048576.0f;
// Square of an area that floats cannot tell from 0, where the edges have length 1.
TETRALIGHT_CONST float tetralight_flat_triangle = 1e-12f;

float tetralight_evaluate(vec4 c, float t) {
    return ((c.w * t + c.z) * t + c.y) * t + c.x;
}

float tetralight_derivative(vec4 c, float t) {
    return (3.0f * c.w * t + 2.0f * c.z) * t + c.y;
}

// The root in [low, high], where the cubic goes from positive to not positive: Newton's steps, or
// halving where they leave the bracket.
float tetralight_bracketed_root(vec4 c, float low, float high) {
    float t = 0.5f * (low + high);
    for (int i = 0; i < 48; ++i) {
        float value = tetralight_evaluate(c, t);
        if (value > 0.0f) {
            low = t;
        } else {
            high = t;
        }
        float next = t - value / tetralight_derivative(c, t);
        if (!(next > low && next < high)) next = 0.5f * (low + high);
        if (abs(next - t) <= 1e-7f * high) return next;
        t = next;
    }
    return t;
}

// The root of a cubic that is positive at 0 and falls ever faster: Newton's steps come down to it
// from the root of its first three terms.
float tetralight_falling_root(vec4 c) {
    float t = 2.0f * c.x / (sqrt(c.y * c.y - 4.0f * c.z * c.x) - c.y);
    for (int i = 0; i < 24; ++i) {
        float next = t - tetralight_evaluate(c, t) / tetralight_derivative(c, t);
        if (!(next < t * (1.0f - 1e-4f))) return next;
        t = next;
    }
    return t;
}

// Smallest t >= 0 where the cubic, positive at 0, is no longer positive; -1: none.
float tetralight_first_root(vec4 c) {
    if (c.y < 0.0f && c.z <= 0.0f && c.w <= 0.0f) {
        float root = tetralight_falling_root(c);
        return root <= tetralight_farthest_root ? root : -1.0f;
    }
    // Where the slope is zero: stable quadratic formula.
    float low = 0.0f;
    float discriminant = c.z * c.z - 3.0f * c.w * c.y;
    if (discriminant >= 0.0f) {
        float q = -c.z + (c.z < 0.0f ? 1.0f : -1.0f) * sqrt(discriminant);
        float first = c.w != 0.0f ? q / (3.0f * c.w) : -1.0f;
        float second = q != 0.0f ? c.y / q : -1.0f;
        float nearer = min(first, second);
        float farther = max(first, second);
        if (nearer > low) {
            if (tetralight_evaluate(c, nearer) <= 0.0f) {
                return tetralight_bracketed_root(c, low, nearer);
            }
            low = nearer;
        }
        if (farther > low) {
            if (tetralight_evaluate(c, farther) <= 0.0f) {
                return tetralight_bracketed_root(c, low, farther);
            }
            low = farther;
        }
    }
    float high = max(1.0f, 2.0f * low);
    for (int i = 0; i < 21 && high <= tetralight_farthest_root; ++i) {
        if (tetralight_evaluate(c, high) <= 0.0f) return tetralight_bracketed_root(c, low, high);
        high *= 2.0f;
    }
    return -1.0f;
}

// More than rounding makes of a cubic whose lengths are of order 1.
TETRALIGHT_CONST float tetralight_risen = 1e-6f;

// As `tetralight_first_root`, for any cubic; -1 where it is negative from the beginning. A triangle
// that is thinner than steps of its positions may face inwards and turn outwards as it grows: there
// the cubic rises above zero first.
float tetralight_first_meeting(vec4 c) {
    if (c.x > 0.0f) return tetralight_first_root(c);
    float discriminant = c.z * c.z - 3.0f * c.w * c.y;
    if (discriminant >= 0.0f) {
        float q = -c.z + (c.z < 0.0f ? 1.0f : -1.0f) * sqrt(discriminant);
        float top = max(c.w != 0.0f ? q / (3.0f * c.w) : -1.0f, q != 0.0f ? c.y / q : -1.0f);
        if (top > 0.0f && tetralight_evaluate(c, top) > tetralight_risen) {
            float high = max(1.0f, 2.0f * top);
            for (int i = 0; i < 21 && tetralight_evaluate(c, high) > 0.0f; ++i) high *= 2.0f;
            if (high <= tetralight_farthest_root) return tetralight_bracketed_root(c, top, high);
        }
    }
    return c.x == 0.0f ? 0.0f : -1.0f;
}

// The position lies behind the hull cell's triangle: the walk goes on through neighbor 3.
vec4 tetralight_go_inside() {
    return vec4(0.0f, 0.0f, 0.0f, -1.0f);
}

vec4 tetralight_hull_triangle_weights(uint cell, uvec4 vertices, vec3 position) {
    vec3 p2 = tetralight_probe_position(vertices.z);
    vec3 a = tetralight_probe_position(vertices.x) - p2;
    vec3 b = tetralight_probe_position(vertices.y) - p2;
    vec3 d = position - p2;
    float square = max(dot(d, d), max(dot(d - a, d - a), dot(d - b, d - b)));
    float unit = inversesqrt(max(square, 1e-36f));
    a = a * unit;
    b = b * unit;
    d = d * unit;
    vec3 v2 = tetralight_hull_ray(cell, 2u);
    vec3 da = tetralight_hull_ray(cell, 0u) - v2;
    vec3 db = tetralight_hull_ray(cell, 1u) - v2;
    // The normal of the moved triangle: n0 + n1 t + n2 t^2.
    vec3 n0 = cross(a, b);
    vec3 n1 = cross(a, db) + cross(da, b);
    vec3 n2 = cross(da, db);
    float t = tetralight_first_meeting(vec4(dot(n0, d), dot(n1, d) - dot(n0, v2),
                                            dot(n2, d) - dot(n1, v2), -dot(n2, v2)));
    if (t < 0.0f) return tetralight_go_inside();
    vec3 e0 = a + da * t;
    vec3 e1 = b + db * t;
    vec3 rest = d - v2 * t;
    vec3 normal = cross(e0, e1);
    float area = dot(normal, normal);
    float longest = max(dot(e0, e0), dot(e1, e1));
    if (!(area > tetralight_flat_triangle * longest * longest)) return tetralight_go_inside();
    float w0 = dot(cross(rest, e1), normal) / area;
    float w1 = dot(cross(e0, rest), normal) / area;
    return vec4(w0, w1, 1.0f - w0 - w1, 0.0f);
}

// Beyond an edge of the hull of probes in a plane.
vec4 tetralight_hull_edge_weights(uint cell, uvec4 vertices, vec3 position) {
    vec3 axis = vec3(tetralight_volume.axis.x, tetralight_volume.axis.y, tetralight_volume.axis.z);
    vec3 p0 = tetralight_probe_position(vertices.x);
    vec3 e = tetralight_probe_position(vertices.y) - p0;
    vec3 d = position - p0;
    float unit = inversesqrt(max(max(dot(d, d), dot(d - e, d - e)), 1e-36f));
    e = e * unit;
    d = d * unit;
    vec3 v0 = tetralight_hull_ray(cell, 0u);
    vec3 de = tetralight_hull_ray(cell, 1u) - v0;
    float t = tetralight_first_meeting(
        vec4(dot(cross(d, e), axis), dot(cross(d, de) - cross(v0, e), axis),
             -dot(cross(v0, de), axis), 0.0f));
    if (t < 0.0f) return tetralight_go_inside();
    vec3 edge = e + de * t;
    vec3 across = edge - axis * dot(edge, axis);
    float square = dot(across, edge);
    if (!(square > 0.0f)) return tetralight_go_inside();
    float weight = dot(across, d - v0 * t) / square;
    return vec4(1.0f - weight, weight, 0.0f, 0.0f);
}

// Beyond an end of probes on a line.
vec4 tetralight_hull_end_weights(uint cell, uvec4 vertices, vec3 position) {
    vec3 d = position - tetralight_probe_position(vertices.x);
    if (dot(d, tetralight_hull_ray(cell, 0u)) < 0.0f) return tetralight_go_inside();
    return vec4(1.0f, 0.0f, 0.0f, 0.0f);
}
