// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>

#include "bake/image/image.h"
#include "bake/scene/scene.h"

namespace tetralight {

/// A camera at `eye` that looks at `target`, with world Y up. Where both are one point it looks
/// along -Z.
[[nodiscard]] Camera look_at(const glm::dvec3& eye, const glm::dvec3& target, double fov_y_radians);

struct RenderSettings {
    uint32_t width = 960;
    uint32_t height = 540;
    /// Camera rays a pixel, along each axis.
    uint32_t samples_per_axis = 4;
    /// Factor before tone mapping; 0 = so that the picture's log-average luminance becomes 0.18.
    float exposure = 0.0f;
    /// 0 = all.
    uint32_t thread_count = 0;
};

/// Radiance seen from a world position in a unit direction. Called from many threads.
using TraceView = std::function<glm::vec3(const glm::dvec3& origin, glm::vec3 direction)>;

/// Averages the view's radiance over each pixel, by rays on a regular sub-pixel grid.
[[nodiscard]] ImageF render_view(const Camera& camera, const RenderSettings& settings,
                                 const TraceView& trace);

/// Exposes, tone-maps (Khronos PBR Neutral) and encodes as sRGB.
[[nodiscard]] Image8 develop(const ImageF& radiance, float exposure);

}  // namespace tetralight
