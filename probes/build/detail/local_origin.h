// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <span>

namespace tetralight::detail {

/// What float positions are relative to: the world's own origin where that costs no precision, else
/// the centre of the bulk of the probes, so that a few far away do not move it.
/// Precondition: `positions` are in Hilbert order (see `hilbert_order`).
[[nodiscard]] glm::dvec3 local_origin(std::span<const glm::dvec3> positions);

}  // namespace tetralight::detail
