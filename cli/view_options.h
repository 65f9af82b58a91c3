// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <string>

#include <tetralight/base/result.h>
#include <tetralight/cli/values.h>
#include <tetralight/render/image_renderer.h>

namespace tetralight::cli {

/// The size and exposure of a picture, and the camera if the user gave one.
struct ViewOptions {
    RenderSettings settings;
    glm::dvec3 eye{0.0};
    glm::dvec3 target{0.0};
    double fov_degrees = 45.0;
    bool has_camera = false;
    /// Name of a camera of the scene; empty = the scene's first, or an overview.
    std::string camera_name;

    /// Throws a `UsageError` if the camera looks at its own position.
    explicit ViewOptions(const Values& values);

    /// The user's camera, or one of the scene. Returns not_found if there is no camera of
    /// that name.
    [[nodiscard]] Result<Camera> camera_in(const Scene& scene, const std::string& scene_path) const;

    /// The user's camera. Precondition: `has_camera`.
    [[nodiscard]] Camera camera() const;
};

/// A camera that sees all of a scene from the front, above and to the right.
[[nodiscard]] Camera overview(const Scene& scene);

}  // namespace tetralight::cli
