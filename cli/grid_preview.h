// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/bake/placement/probe_grid.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/cli/view_options.h>

namespace tetralight::cli {

/// `--preview`: a picture of the scene with the probes of a grid as balls, lit by a quick bake.
/// Balls behind walls show through.
struct GridPreview {
    std::string path;
    ViewOptions view;

    explicit GridPreview(const Values& values) : path(values.text("preview")), view(values) {}

    /// Call before `write` and before long work. Returns not_found if there is no such camera.
    Status choose_camera(const Scene& scene, const std::string& scene_path);

    [[nodiscard]] Status write(const Scene& scene, const ProbeGrid& grid, uint32_t thread_count);

  private:
    Camera camera_;
};

}  // namespace tetralight::cli
