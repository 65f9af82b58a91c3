// SPDX-License-Identifier: Apache-2.0
#include "cli/grid_preview.h"

#include <glm/geometric.hpp>

#include "bake/image/write_image.h"
#include "bake/scene/scene_bounds.h"
#include "cli/view_options.h"
#include "pipeline/bake_volume.h"
#include "pipeline/render_gizmos.h"

namespace tetralight::cli {
namespace {

/// Balls of this share of the scene's diagonal can be told apart, and hide little.
constexpr double kBallShare = 0.004;

/// As many as the eye needs.
constexpr uint32_t kSampleCount = 128;

float ball_radius(const Scene& scene) {
    const auto bounds = scene_bounds(scene, [](const MeshInstance&) { return true; });
    const double diagonal = bounds ? glm::length(bounds->size()) : 0.0;
    return static_cast<float>(diagonal > 0.0 ? kBallShare * diagonal : 0.1);
}

}  // namespace

Status write_preview(const std::string& path, const Scene& scene, const ProbeGrid& grid,
                     uint32_t thread_count) {
    BakeVolumeSettings settings;
    settings.bake.sample_count = kSampleCount;
    settings.bake.thread_count = thread_count;
    const auto baked = bake_volume(scene, grid.groups, settings);
    if (!baked) return baked.error();
    const Camera camera = scene.cameras.empty() ? overview(scene) : scene.cameras.front();
    RenderSettings render;
    render.thread_count = thread_count;
    const ProbeVolumeView volume = baked->volume.view();
    const auto shader = SceneShader::make(scene, volume);
    if (!shader) return shader.error();
    GizmoSettings show;
    show.has_probes = true;
    show.ball_radius = ball_radius(scene);
    const auto image = render_gizmos(ray_traced_pictures(*shader, volume), volume, camera, render,
                                     make_gizmos(volume, {}, show));
    if (!image) return image.error();
    return write_png(path, *image);
}

}  // namespace tetralight::cli
