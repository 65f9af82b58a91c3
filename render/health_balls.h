// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>

#include <tetralight/bake/image/image.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/render/image_renderer.h>
#include <tetralight/render/light_balls.h>

namespace tetralight {

/// What the balls of probes show.
enum class ProbeColor : uint8_t {
    Light,     ///< white balls, lit by what the probe holds
    Validity,  ///< red = 0, yellow = 0.75 (below: the probe is in geometry), teal = 1
    Error,     ///< relative standard error: teal = 0.1 %, yellow = 1 %, red = 10 %; grey: unknown
};

/// Colour of a fraction of valid rays, 0 to 1, as `ProbeColor::Validity` shows it; sRGB-encoded.
[[nodiscard]] glm::vec3 validity_color(float validity);

/// Colour of a probe's health, sRGB-encoded, 0 to 1. Precondition: `quantity` is not `Light`.
[[nodiscard]] glm::vec3 health_color(const ProbeVolumeView& volume, uint32_t probe,
                                     ProbeColor quantity);

/// Distance to the first surface that hides balls, from a world position in a unit direction;
/// infinite if there is none.
using HidingDistance = std::function<float(const glm::dvec3& origin, glm::vec3 direction)>;

/// Draws balls, one a probe of the volume, over a developed picture from the same camera, so that
/// their colours do not depend on the exposure. Balls of poor health (validity below 0.75, error
/// above 1 %) are drawn at half opacity where a surface hides them.
void draw_health_balls(Image8& image, const Camera& camera, const RenderSettings& settings,
                       const HidingDistance& surfaces, const LightBalls& balls,
                       const ProbeVolumeView& volume, ProbeColor quantity);

}  // namespace tetralight
