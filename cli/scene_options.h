// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <glm/vec3.hpp>
#include <string>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/cli/sky_options.h>

namespace tetralight::cli {

/// The scene to work on, and light that the command line adds to it.
struct SceneOptions {
    std::string path;
    std::string adjustments;
    SkyOptions sky;
    glm::dvec3 sun_direction{0.0};
    glm::dvec3 sun_irradiance{0.0};
    double sun_angle_degrees = 0.0;
    std::string sun_mode = "mixed";

    /// Declares SCENE and the light options.
    void add_to(CLI::App& command);

    /// Reads the scene and adds the light and the adjustment volumes.
    [[nodiscard]] Result<Scene> read() const;

  private:
    [[nodiscard]] Status add_adjustments(Scene& scene) const;
    void add_sun(Scene& scene) const;
};

}  // namespace tetralight::cli
