// SPDX-License-Identifier: Apache-2.0
// Weights in the cells outside the hull: those of the first triangle (p_i + t v_i), t >= 0, whose
// plane contains the position (Cupisz, GDC 2012), as in probes/detail/hull_cell.cpp. Positions are
// subtracted first, so that floats suffice far from the hull too.

TETRALIGHT_CONST float tetralight_farthest_root = 1048576.0f;
// Squared area that floats cannot distinguish from 0 for edges of length 1.
TETRALIGHT_CONST float tetralight_flat_triangle = 1e-12f;

float tetralight_evaluate(vec4 c, float t) {
    return ((c.w * t + c.z) * t + c.y) * t + c.x;
}

float tetralight_derivative(vec4 c, float t) {
    return (3.0f * c.w * t + 2.0f * c.z) * t + c.y;
}

// The root in [lower, upper], where the cubic changes from positive to not positive: Newton's
// method, or bisection for steps that leave the bracket.
float tetralight_bracketed_root(vec4 c, float lower, float upper) {
    float t = 0.5f * (lower + upper);
    for (int i = 0; i < 48; ++i) {
        float value = tetralight_evaluate(c, t);
        if (value > 0.0f) {
            lower = t;
        } else {
            upper = t;
        }
        float next = t - value / tetralight_derivative(c, t);
        if (!(next > lower && next < upper)) next = 0.5f * (lower + upper);
        if (abs(next - t) <= 1e-7f * upper) return next;
        t = next;
    }
    return t;
}

// The root of a concave cubic that is positive and falling at 0: Newton's method starts at the root
// of its first three terms and decreases towards it.
float tetralight_falling_root(vec4 c) {
    float t = 2.0f * c.x / (sqrt(c.y * c.y - 4.0f * c.z * c.x) - c.y);
    for (int i = 0; i < 24; ++i) {
        float next = t - tetralight_evaluate(c, t) / tetralight_derivative(c, t);
        if (!(next < t * (1.0f - 1e-4f))) return next;
        t = next;
    }
    return t;
}

// Smallest t >= 0 at which a cubic that is positive at 0 is not positive; -1 if there is none.
float tetralight_first_root(vec4 c) {
    if (c.y < 0.0f && c.z <= 0.0f && c.w <= 0.0f) {
        float root = tetralight_falling_root(c);
        return root <= tetralight_farthest_root ? root : -1.0f;
    }
    // The zeros of the derivative, by the stable quadratic formula.
    float lower = 0.0f;
    float discriminant = c.z * c.z - 3.0f * c.w * c.y;
    if (discriminant >= 0.0f) {
        float q = -c.z + (c.z < 0.0f ? 1.0f : -1.0f) * sqrt(discriminant);
        float first = c.w != 0.0f ? q / (3.0f * c.w) : -1.0f;
        float second = q != 0.0f ? c.y / q : -1.0f;
        float nearer = min(first, second);
        float farther = max(first, second);
        if (nearer > lower) {
            if (tetralight_evaluate(c, nearer) <= 0.0f) {
                return tetralight_bracketed_root(c, lower, nearer);
            }
            lower = nearer;
        }
        if (farther > lower) {
            if (tetralight_evaluate(c, farther) <= 0.0f) {
                return tetralight_bracketed_root(c, lower, farther);
            }
            lower = farther;
        }
    }
    float upper = max(1.0f, 2.0f * lower);
    for (int i = 0; i < 21 && upper <= tetralight_farthest_root; ++i) {
        if (tetralight_evaluate(c, upper) <= 0.0f) {
            return tetralight_bracketed_root(c, lower, upper);
        }
        upper *= 2.0f;
    }
    return -1.0f;
}

// Larger than the rounding error of a cubic whose lengths are of order 1.
TETRALIGHT_CONST float tetralight_risen = 1e-6f;

// As `tetralight_first_root` for any cubic; -1 if it is never positive. A triangle that is thinner
// than the rounding of its positions may face inwards at t = 0 and outwards later: the cubic then
// becomes positive first.
float tetralight_first_meeting(vec4 c) {
    if (c.x > 0.0f) return tetralight_first_root(c);
    float discriminant = c.z * c.z - 3.0f * c.w * c.y;
    if (discriminant >= 0.0f) {
        float q = -c.z + (c.z < 0.0f ? 1.0f : -1.0f) * sqrt(discriminant);
        float top = max(c.w != 0.0f ? q / (3.0f * c.w) : -1.0f, q != 0.0f ? c.y / q : -1.0f);
        if (top > 0.0f && tetralight_evaluate(c, top) > tetralight_risen) {
            float upper = max(1.0f, 2.0f * top);
            for (int i = 0; i < 21 && tetralight_evaluate(c, upper) > 0.0f; ++i) upper *= 2.0f;
            if (upper <= tetralight_farthest_root) return tetralight_bracketed_root(c, top, upper);
        }
    }
    return c.x == 0.0f ? 0.0f : -1.0f;
}

// The position is inside the hull cell's triangle: the walk continues with neighbor 3.
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
    // The normal of the triangle at t: n0 + n1 t + n2 t^2.
    vec3 n0 = cross(a, b);
    vec3 n1 = cross(a, db) + cross(da, b);
    vec3 n2 = cross(da, db);
    float t = tetralight_first_meeting(vec4(dot(n0, d), dot(n1, d) - dot(n0, v2),
                                            dot(n2, d) - dot(n1, v2), -dot(n2, v2)));
    if (t < 0.0f) return tetralight_go_inside();
    vec3 e0 = a + da * t;
    vec3 e1 = b + db * t;
    vec3 offset = d - v2 * t;
    vec3 normal = cross(e0, e1);
    float area = dot(normal, normal);
    float longest = max(dot(e0, e0), dot(e1, e1));
    if (!(area > tetralight_flat_triangle * longest * longest)) return tetralight_go_inside();
    float w0 = dot(cross(offset, e1), normal) / area;
    float w1 = dot(cross(e0, offset), normal) / area;
    return vec4(w0, w1, 1.0f - w0 - w1, 0.0f);
}

// Outside an edge of the hull of probes in a plane.
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
    vec3 along = edge - axis * dot(edge, axis);
    float square = dot(along, edge);
    if (!(square > 0.0f)) return tetralight_go_inside();
    float weight = dot(along, d - v0 * t) / square;
    return vec4(1.0f - weight, weight, 0.0f, 0.0f);
}

// Outside an end of probes on a line.
vec4 tetralight_hull_end_weights(uint cell, uvec4 vertices, vec3 position) {
    vec3 d = position - tetralight_probe_position(vertices.x);
    if (dot(d, tetralight_hull_ray(cell, 0u)) < 0.0f) return tetralight_go_inside();
    return vec4(1.0f, 0.0f, 0.0f, 0.0f);
}
