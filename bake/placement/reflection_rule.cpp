// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/reflection_rule.h>

#include <algorithm>

#include <tetralight/bake/placement/free_space.h>

namespace tetralight {

bool allows_reflection_probe(const TraceScene& traced, const ReflectionRule& rule,
                             const glm::dvec3& position, double clearance) {
    return !adjustment_at(rule.adjustments, position).forbids_probes &&
           is_free_with_clearance(traced, position, clearance);
}

ReflectionPlace make_reflection_place(const glm::dvec3& position, const WorldBox& box,
                                      int importance) {
    const glm::dvec3 size = box.size();
    ReflectionPlace place;
    place.position = position;
    place.box_center = glm::vec3(box.center() - position);
    place.half_size = glm::vec3(0.5 * size);
    constexpr double kBlendFraction = 0.1;
    place.blend_distance = static_cast<float>(kBlendFraction * std::min({size.x, size.y, size.z}));
    place.importance = importance;
    return place;
}

}  // namespace tetralight
