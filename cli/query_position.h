// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include <tetralight/base/result.h>

namespace tetralight::cli {

/// Whether each position of the input is followed by the normal of the surface that it lies on.
enum class Normals : uint8_t { None, Given };

/// One position of the input.
struct QueryPosition {
    glm::vec3 position{0.0f};
    /// Unit; 0 if the input has no normals.
    glm::vec3 normal{0.0f};
};

/// The names of the numbers of a position, in messages.
inline constexpr const char* kNumberNames[] = {"x", "y", "z", "nx", "ny", "nz"};

/// 3 or 6.
[[nodiscard]] constexpr int number_count(Normals normals) {
    return normals == Normals::Given ? 6 : 3;
}

/// The position of its numbers, with a normal of length 1. Returns corrupt, with the field
/// `normal`, if the normal is zero or not finite. Precondition: three numbers, or six.
[[nodiscard]] Result<QueryPosition> make_query_position(std::span<const float> numbers);

}  // namespace tetralight::cli
