// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

#include <tetralight/probes/detail/cell_corners.h>
#include <tetralight/probes/detail/query_block.h>
#include <tetralight/probes/is_finite.h>

namespace tetralight::detail {

/// Where a query is, and how it walks.
struct QueryPlace {
    glm::dvec3 local{0.0};
    Course course = Course::NotFinite;
};

/// For volumes with tetrahedra (`has_tetrahedra`).
[[nodiscard]] inline QueryPlace find_place(const VolumeInfo& info,
                                           const glm::vec3& position) noexcept {
    if (!is_finite(position)) return {};
    const LocalPosition found = find_local(info, position);
    if (found.is_moved) return {found.position, Course::Alone};
    const bool is_float = glm::dvec3(glm::vec3(found.position)) == found.position;
    return {found.position, is_float ? Course::InFloat : Course::InDouble};
}

}  // namespace tetralight::detail
