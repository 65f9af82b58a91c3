// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/probes/distant_light.h>
#include <tetralight/probes/sh.h>

namespace tetralight {

/// Radiance of the environment alone as SH coefficients. Free of noise: a midpoint rule with one or
/// more samples per texel, each weighted by its solid angle, so that even a sun of one texel has
/// its full weight. Texels of images smaller than 256 rows or columns are subdivided, because the
/// bilinear lookup varies within them. `thread_count` 0 = all; the bits are the same for any.
[[nodiscard]] RadianceSh project_environment(const Environment& environment,
                                             uint32_t thread_count = 0);

/// The same as distant light, which has one band more.
[[nodiscard]] DistantLight project_sky(const Environment& environment, uint32_t thread_count = 0);

}  // namespace tetralight
