// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "pipeline/image_renderer.h"

namespace tetralight::cli {

/// The size and exposure of a picture, and the camera if the user gave one.
struct ViewOptions {
    RenderSettings settings;
    glm::dvec3 eye{0.0};
    glm::dvec3 target{0.0};
    double fov_degrees = 45.0;
    bool has_camera = false;
    /// For what excludes it.
    CLI::Option* eye_option = nullptr;

    void add_to(CLI::App& command);

    /// The user's camera. Precondition: `has_camera`.
    [[nodiscard]] Camera camera() const;
};

/// A camera that sees all of a scene from the front, above and to the right.
[[nodiscard]] Camera overview(const Scene& scene);

}  // namespace tetralight::cli
