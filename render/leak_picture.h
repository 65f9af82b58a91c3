// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include <tetralight/bake/image/image.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/pipeline/check_leaks.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// Color of the light through walls at a place, as a share of the mean light; sRGB-encoded, 0 to 1:
/// grey up to 0.1 %, orange at 1 %, red at 10 %, white from 100 % on.
[[nodiscard]] glm::vec3 leak_color(double share);

/// Draws the scene in two views without perspective, one over the other: a plan seen from above and
/// a section seen from the front (along -z), lit by the volume. Both are cut where half of the
/// light through walls is on either side, so that no roof hides the rooms; cut walls are dark.
/// Every place of the report is a ball in the color of its light through walls, the worst ones on
/// top. Returns the errors of `SceneShader::make` and `TraceScene::make_static`. Precondition: the
/// report has a place.
[[nodiscard]] Result<Image8> draw_leaks(const Scene& scene, const ProbeVolumeView& volume,
                                        const LeakReport& report, uint32_t thread_count = 0);

}  // namespace tetralight
