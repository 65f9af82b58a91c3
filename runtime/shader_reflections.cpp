// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/shader_reflections.h>

#include <algorithm>

namespace tetralight {

ShaderReflectionProbe make_shader_reflection_probe(const ReflectionProbe& probe, uint32_t cube,
                                                   const glm::dvec3& origin) noexcept {
    ShaderReflectionProbe made;
    made.position = {glm::vec3(probe.position - origin), static_cast<float>(cube)};
    made.box_center = {probe.box_center, probe.blend_distance};
    if (!probe.is_everywhere()) made.half_size = {probe.half_size, 1.0f};
    made.x_axis = {probe.axes[0], 0.0f};
    made.y_axis = {probe.axes[1], 0.0f};
    made.z_axis = {probe.axes[2], 0.0f};
    return made;
}

ShaderReflectionBlend make_shader_reflection_blend(const ReflectionsView& reflections,
                                                   const ReflectionBlend& blend,
                                                   const glm::dvec3& origin) noexcept {
    ShaderReflectionBlend made;
    ShaderReflectionProbe* const probes[]{&made.first, &made.second, &made.third};
    for (int i = 0; i < 3; ++i) {
        const uint32_t probe = blend.probes[i];
        if (!(blend.weights[i] > 0.0f) || probe >= reflections.probes.size()) continue;
        *probes[i] = make_shader_reflection_probe(reflections.probes[probe], probe, origin);
        made.weights[i] = blend.weights[i];
    }
    made.weights.w = static_cast<float>(std::max(reflections.level_count, 1u) - 1);
    return made;
}

}  // namespace tetralight
