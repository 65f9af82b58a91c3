// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <span>

namespace tetralight::detail {

/// The origin of float positions: that of the world if this costs no precision, otherwise the
/// center of most of the probes, which a few probes far away do not move. Precondition: `positions`
/// are in Hilbert order (see `hilbert_order`).
[[nodiscard]] glm::dvec3 local_origin(std::span<const glm::dvec3> positions);

}  // namespace tetralight::detail
