// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/probes/distant_light.h>
#include <tetralight/probes/sh.h>

namespace tetralight {

/// Light of the environment alone, without noise: a midpoint rule with one sample a texel, each
/// with its own solid angle, so that the smallest sun counts as what it is. Texels of a small image
/// are split, as the light varies within them. `thread_count` 0 = all; same bits for any.
[[nodiscard]] RadianceSh project_environment(const Environment& environment,
                                             uint32_t thread_count = 0);

/// The same with one band more.
[[nodiscard]] DistantLight project_sky(const Environment& environment, uint32_t thread_count = 0);

}  // namespace tetralight
