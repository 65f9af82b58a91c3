// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>

#include <tetralight/base/result.h>

namespace tetralight {

/// Where a reflection probe is to be baked: `extras.reflection_probe` of a glTF node.
struct ReflectionPlace {
    std::string name;
    glm::dvec3 position{0.0};  ///< world
    /// The center of the box relative to `position`, world axes, metres.
    glm::vec3 box_center{0.0f};
    /// Half of the box along its axes, metres.
    glm::vec3 half_size{5.0f};
    /// The axes of the box as columns: unit vectors at right angles, in world axes.
    glm::mat3 axes{1.0f};
    /// Outside the box the probe fades out over this distance, metres; at least 0.
    float blend_distance = 0.25f;
    /// Probes of higher importance hide those of lower importance.
    int32_t importance = 1;
    /// Surfaces nearer than this are not in the cube, metres; at least 0.
    float near_distance = 0.0f;

    bool operator==(const ReflectionPlace&) const = default;
};

/// Returns invalid_argument if a number is not finite or out of range, or if the axes are not unit
/// vectors at right angles. The field is a member as JSON has it: `.blend_distance`.
[[nodiscard]] Status check_reflection_place(const ReflectionPlace& place);

/// Checks the places of one file, whose names are to be unique. Returns invalid_argument with the
/// member as the field: `reflection_probes[1].name`.
[[nodiscard]] Status check_reflection_places(std::span<const ReflectionPlace> places);

}  // namespace tetralight
