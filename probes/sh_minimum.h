// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

#include <tetralight/probes/sh.h>

namespace tetralight {

/// The least irradiance over all unit normals, one a channel. Not sampled: the minimum of the
/// polynomial, up to rounding in double, and never above it by more than that.
[[nodiscard]] glm::dvec3 minimum_irradiance(const IrradianceSh& irradiance) noexcept;

}  // namespace tetralight
