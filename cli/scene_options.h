// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/cli/scene_reading.h>
#include <tetralight/cli/sky_options.h>

namespace tetralight::cli {

/// The scene to work on, and light that the settings add to it.
struct SceneOptions {
    std::string path;
    SceneReading reading;
    std::string adjustments;
    SkyOptions sky;
    glm::dvec3 sun_direction{0.0};
    glm::dvec3 sun_irradiance{0.0};
    double sun_angle_degrees = 0.0;
    LightMode sun_mode = LightMode::Mixed;

    explicit SceneOptions(const Values& values);

    /// Reads the scene and adds the light and the adjustment volumes.
    [[nodiscard]] Result<Scene> read(NormalMaps normal_maps = NormalMaps::Skip) const;

    /// The files that are read.
    [[nodiscard]] std::vector<std::string> inputs() const { return {path, adjustments, sky.path}; }

  private:
    [[nodiscard]] Status add_adjustments(Scene& scene) const;
    void add_sun(Scene& scene) const;
};

}  // namespace tetralight::cli
