// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/cli/ball_options.h>
#include <tetralight/render/image_renderer.h>
#include <tetralight/render/scene_light.h>

namespace tetralight::cli {

/// What the window showed.
struct BallShow {
    uint64_t frame_count = 0;
    double seconds = 0.0;
};

/// Shows the turning ball in a window until the user closes it, or for so many frames (0: no end).
/// Dragging turns the camera, the wheel zooms; P, L, O: probes, proxy volume, off; S: specular;
/// space: stop and go. Errors: there is no screen, and the renderer's.
[[nodiscard]] Result<BallShow> show_ball(const BallOptions& ball, const Scene& scene,
                                         SceneLight light, const ProbeVolumeView& volume,
                                         const Camera& camera, const RenderSettings& settings,
                                         uint64_t frame_count);

}  // namespace tetralight::cli
