// SPDX-License-Identifier: Apache-2.0
// Samples reflection probes. The C++ twins are reflection/sample_reflections.h and split_sum.h;
// runtime/shader_reflections.h fills the structs. The texture is an array of RGBA16F cubes with all
// levels and the linear filter, also between levels and across faces
// (GL_TEXTURE_CUBE_MAP_SEAMLESS). GLSL before 4.00 and GLSL ES before 3.20 have no arrays of cubes:
// they sample one cube after the other by tetralight_sample_reflection_cube. In HLSL the sampler
// follows its texture:
//     tetralight_sample_reflections(cubes, cubes_sampler, blend, position, mirrored, roughness)
//
// The light of a surface, with its normal, the unit vector to the eye and F0
// (tetralight_specular_f0):
//     vec3 mirrored = reflect(-to_eye, normal);
//     vec3 radiance = tetralight_sample_reflections(cubes, blend, position, mirrored, roughness);
//     vec2 scale_and_bias = tetralight_split_sum(table, dot(normal, to_eye), roughness);
//     color += radiance * (f0 * scale_and_bias.x + scale_and_bias.y);

// A probe and its box, relative to an origin that the program chooses.
struct TetralightReflectionProbe {
    vec4 position;    // w: its place in the array of cubes
    vec4 box_center;  // relative to the position; w: blend distance
    vec4 half_size;   // w: 1, or 0 if the probe is used everywhere and has no box
    vec4 x_axis;      // of the box
    vec4 y_axis;
    vec4 z_axis;
};

// Up to three probes and their weights, which sum to 1.
struct TetralightReflectionBlend {
    TetralightReflectionProbe first;
    TetralightReflectionProbe second;
    TetralightReflectionProbe third;
    vec4 weights;  // w: number of levels - 1
};

// A vector in the axes of the box.
vec3 tetralight_box_from_world(TetralightReflectionProbe probe, vec3 v) {
    return vec3(dot(v, probe.x_axis.xyz), dot(v, probe.y_axis.xyz), dot(v, probe.z_axis.xyz));
}

// A vector in the axes of the box, in the world.
vec3 tetralight_world_from_box(TetralightReflectionProbe probe, vec3 v) {
    return probe.x_axis.xyz * v.x + probe.y_axis.xyz * v.y + probe.z_axis.xyz * v.z;
}

vec3 tetralight_place_in_box(TetralightReflectionProbe probe, vec3 position) {
    return tetralight_box_from_world(probe,
                                     position - probe.position.xyz - probe.box_center.xyz);
}

// Walls on the sides of a box count as inside it, however their positions are rounded: as a multiple
// of the box.
TETRALIGHT_CONST float tetralight_box_reach = 1.001f;

// How much a probe counts at a place in the axes of its box: 1 in the box, 0 farther outside than
// the blend distance, a smooth step between.
float tetralight_influence_in_box(TetralightReflectionProbe probe, vec3 place) {
    vec3 beyond = abs(place) - probe.half_size.xyz * tetralight_box_reach;
    float distance_to_box = length(max(beyond, vec3(0.0f, 0.0f, 0.0f)));
    float blend_distance = probe.box_center.w;
    if (distance_to_box == 0.0f) return 1.0f;
    if (!(distance_to_box < blend_distance)) return 0.0f;
    float t = 1.0f - distance_to_box / blend_distance;
    return t * t * (3.0f - 2.0f * t);
}

// The same at a position; 1 if the probe has no box.
float tetralight_reflection_influence(TetralightReflectionProbe probe, vec3 position) {
    if (probe.half_size.w == 0.0f) return 1.0f;
    return tetralight_influence_in_box(probe, tetralight_place_in_box(probe, position));
}

// The unit direction from a probe to where a ray from `position` in a unit direction hits the side
// of its box. Outside the box mixed, by the influence, from that of the nearest place in the box
// and the direction itself.
vec3 tetralight_project_on_box(TetralightReflectionProbe probe, vec3 position, vec3 direction) {
    if (probe.half_size.w == 0.0f) return direction;
    vec3 half_size = probe.half_size.xyz;
    vec3 place = tetralight_place_in_box(probe, position);
    float influence = tetralight_influence_in_box(probe, place);
    if (influence == 0.0f) return direction;
    place = clamp(place, -half_size, half_size);
    vec3 along = tetralight_box_from_world(probe, direction);
    vec3 speed = max(abs(along), vec3(1e-20f, 1e-20f, 1e-20f));
    vec3 reach = (half_size - place * sign(along)) / speed;
    vec3 hit = place + along * min(reach.x, min(reach.y, reach.z));
    vec3 from_probe = probe.box_center.xyz + tetralight_world_from_box(probe, hit);
    float square = dot(from_probe, from_probe);
    if (!(square > 0.0f)) return direction;
    return normalize(mix(direction, from_probe * inversesqrt(square), influence));
}

// The level of a roughness, with a fraction. `last`: number of levels - 1.
float tetralight_reflection_level(float roughness, float last) {
    float most_one = clamp(roughness, 0.0f, 1.0f);
    return most_one * (2.0f - most_one) * last;
}

// Radiance of one cube at a level.
vec3 tetralight_sample_reflection_cube(TETRALIGHT_CUBE(cube), TetralightReflectionProbe probe,
                                       vec3 position, vec3 direction, float level) {
    vec3 along = tetralight_project_on_box(probe, position, direction);
    return TETRALIGHT_SAMPLE_CUBE(cube, along, level).xyz;
}

#ifdef TETRALIGHT_HAS_CUBE_ARRAYS
// Radiance of one cube of an array.
vec3 tetralight_sample_reflection(TETRALIGHT_CUBES(cubes), TetralightReflectionProbe probe,
                                  vec3 position, vec3 direction, float level) {
    vec3 along = tetralight_project_on_box(probe, position, direction);
    return TETRALIGHT_SAMPLE_CUBES(cubes, along, probe.position.w, level).xyz;
}

// The radiance that a surface of a roughness sees in a unit direction: the view mirrored at its
// normal.
vec3 tetralight_sample_reflections(TETRALIGHT_CUBES(cubes), TetralightReflectionBlend blend,
                                   vec3 position, vec3 direction, float roughness) {
    float level = tetralight_reflection_level(roughness, blend.weights.w);
    vec3 radiance = vec3(0.0f, 0.0f, 0.0f);
    if (blend.weights.x > 0.0f) {
        radiance += tetralight_sample_reflection(TETRALIGHT_PASS_CUBES(cubes), blend.first,
                                                 position, direction, level) *
                    blend.weights.x;
    }
    if (blend.weights.y > 0.0f) {
        radiance += tetralight_sample_reflection(TETRALIGHT_PASS_CUBES(cubes), blend.second,
                                                 position, direction, level) *
                    blend.weights.y;
    }
    if (blend.weights.z > 0.0f) {
        radiance += tetralight_sample_reflection(TETRALIGHT_PASS_CUBES(cubes), blend.third,
                                                 position, direction, level) *
                    blend.weights.z;
    }
    return radiance;
}
#endif

// The choice of three probes at each pixel, as blend_reflections makes it. Begin with
// tetralight_no_reflection and add the probes in the order in which they cover each other
// (reflection_order).
struct TetralightReflectionChoice {
    vec4 weights;  // the four largest, in descending order
    vec4 probes;   // of the weights
    float uncovered;
};

TetralightReflectionChoice tetralight_no_reflection() {
    TetralightReflectionChoice choice;
    choice.weights = vec4(0.0f, 0.0f, 0.0f, 0.0f);
    choice.probes = vec4(0.0f, 0.0f, 0.0f, 0.0f);
    choice.uncovered = 1.0f;
    return choice;
}

TetralightReflectionChoice tetralight_add_reflection(TetralightReflectionChoice choice, float probe,
                                                     float influence) {
    vec4 w = choice.weights;
    vec4 p = choice.probes;
    float weight = min(influence, choice.uncovered);
    choice.uncovered -= weight;
    if (weight > w.x) {
        choice.weights = vec4(weight, w.x, w.y, w.z);
        choice.probes = vec4(probe, p.x, p.y, p.z);
    } else if (weight > w.y) {
        choice.weights = vec4(w.x, weight, w.y, w.z);
        choice.probes = vec4(p.x, probe, p.y, p.z);
    } else if (weight > w.z) {
        choice.weights = vec4(w.x, w.y, weight, w.z);
        choice.probes = vec4(p.x, p.y, probe, p.z);
    } else if (weight > w.w) {
        choice.weights.w = weight;
        choice.probes.w = probe;
    }
    return choice;
}

// The weights of the first three probes of a choice. They sum to 1, or are 0 outside all boxes.
vec3 tetralight_reflection_weights(TetralightReflectionChoice choice) {
    vec4 w = choice.weights;
    vec3 rest = vec3(w.x - w.w, w.y - w.w, w.z - w.w);
    float sum = rest.x + rest.y + rest.z;
    if (sum > 0.0f) return rest / sum;
    float third = w.x > 0.0f ? 1.0f / 3.0f : 0.0f;
    return vec3(third, third, third);
}

// Scale and bias of F0 in the reflectance of a surface, from `make_split_sum_table` as a texture of
// two channels with the linear filter and clamped edges.
vec2 tetralight_split_sum(TETRALIGHT_TEXTURE_2D(table), float n_dot_v, float roughness) {
    return TETRALIGHT_SAMPLE_2D(table, vec2(n_dot_v, roughness)).xy;
}

// Reflectance at normal incidence: 0.04 of dielectrics, the base color of metals.
vec3 tetralight_specular_f0(vec3 base_color, float metallic) {
    return mix(vec3(0.04f, 0.04f, 0.04f), base_color, metallic);
}

// What reflections are multiplied with, so that dark corners do not shine: the luminance of the
// irradiance at the place over that at the probes, both on the surface's normal, in [0, 1]. 1 for
// mirrors, below roughness 0.1; this ratio above 0.5.
float tetralight_reflection_occlusion(vec3 irradiance, vec3 probe_irradiance, float roughness) {
    vec3 luminance = vec3(0.2126f, 0.7152f, 0.0722f);
    float here = dot(irradiance, luminance);
    float there = dot(probe_irradiance, luminance);
    if (!(there > 0.0f)) return 1.0f;
    return mix(1.0f, clamp(here / there, 0.0f, 1.0f), smoothstep(0.1f, 0.5f, roughness));
}
