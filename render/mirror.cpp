// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/mirror.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <numbers>

#include <tetralight/reflection/sample_reflections.h>
#include <tetralight/reflection/split_sum.h>

namespace tetralight {

Mirror::Mirror(const ReflectionsView& reflections, bool has_box_projection)
    : reflections_(reflections), has_box_projection_(has_box_projection) {
    if (has_probes()) split_sum_ = make_split_sum_table();
}

glm::vec3 Mirror::radiance(const MirrorPoint& point, const glm::vec3& baked) const {
    const ReflectionBlend blend = blend_reflections(reflections_, point.position);
    const glm::vec3 mirrored = glm::reflect(-point.to_eye, point.normal);
    const glm::vec3 seen =
        has_box_projection_
            ? sample_reflections(reflections_, blend, point.position, mirrored, point.roughness)
            : sample_far_reflections(reflections_, blend, mirrored, point.roughness);
    const glm::vec3 at_probes = reflection_irradiance(reflections_, blend, point.normal);
    const float occlusion =
        reflection_occlusion(baked * std::numbers::pi_v<float>, at_probes, point.roughness);
    const float n_dot_v = std::max(0.0f, glm::dot(point.to_eye, point.normal));
    const glm::vec2 terms = sample_split_sum(split_sum_, n_dot_v, point.roughness);
    return occlusion * seen * (point.f0 * terms.x + terms.y);
}

}  // namespace tetralight
