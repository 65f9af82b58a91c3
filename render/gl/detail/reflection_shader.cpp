// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gl/detail/shader_texts.h>

namespace tetralight::detail {

// The twin of `Mirror` (render/mirror.h).
const char* const kReflectionText = R"(
struct ReflectionProbe {
    TetralightReflectionProbe probe;
    TetralightPackedSh irradiance;
};
// In the order in which they cover each other.
layout(std430, binding = 11) readonly buffer ReflectionProbes {
    ReflectionProbe reflection_probes[];
};
layout(binding = 11) uniform samplerCubeArray reflection_cubes;
layout(binding = 12) uniform sampler2D split_sum_table;

bool reflects_probes() {
    return counts.y > 0u && instances[instance].factors.w > 0.0;
}

// The probe whose box is the nearest; of those at the same distance, the first of the file.
float nearest_reflection(vec3 place) {
    uint nearest = 0u;
    float nearest_square = 1e38;
    for (uint i = 0u; i < counts.y; ++i) {
        TetralightReflectionProbe probe = reflection_probes[i].probe;
        vec3 beyond = max(abs(tetralight_place_in_box(probe, place)) - probe.half_size.xyz, 0.0);
        float square = dot(beyond, beyond);
        bool is_first = probe.position.w < reflection_probes[nearest].probe.position.w;
        if (square > nearest_square || (square == nearest_square && !is_first)) continue;
        nearest = i;
        nearest_square = square;
    }
    return float(nearest);
}

TetralightReflectionChoice choose_reflections(vec3 place) {
    TetralightReflectionChoice choice = tetralight_no_reflection();
    for (uint i = 0u; i < counts.y && choice.uncovered > 0.0; ++i) {
        choice = tetralight_add_reflection(
            choice, float(i), tetralight_reflection_influence(reflection_probes[i].probe, place));
    }
    if (choice.weights.x > 0.0) return choice;
    choice.weights.x = 1.0;
    choice.probes.x = nearest_reflection(place);
    return choice;
}

// What a surface mirrors of the reflection probes. `baked`: irradiance / pi at the place.
vec3 mirrored_light(vec3 place, vec3 normal, vec3 to_eye, vec3 f0, float roughness, vec3 baked) {
    TetralightReflectionChoice choice = choose_reflections(place);
    vec3 weights = tetralight_reflection_weights(choice);
    float level = tetralight_reflection_level(roughness, float(counts.w));
    vec3 mirrored = reflect(-to_eye, normal);
    vec3 seen = vec3(0.0), at_probes = vec3(0.0);
    for (int i = 0; i < 3; ++i) {
        if (!(weights[i] > 0.0)) continue;
        uint index = uint(choice.probes[i]);
        TetralightReflectionProbe probe = reflection_probes[index].probe;
        if (counts.z == 0u) probe.half_size.w = 0.0;  // no box projection
        seen += weights[i] * tetralight_sample_reflection(reflection_cubes, probe, place, mirrored,
                                                          level);
        at_probes += weights[i] * tetralight_sample_sh9(reflection_probes[index].irradiance, normal);
    }
    vec2 terms = tetralight_split_sum(split_sum_table, max(dot(normal, to_eye), 0.0), roughness);
    return seen * (f0 * terms.x + terms.y) *
           tetralight_reflection_occlusion(baked, at_probes, roughness);
}
)";

}  // namespace tetralight::detail
