// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/cli/values.h>

namespace tetralight::cli {

/// Sums over samples and bounces stay far from the largest float, 3e38.
inline constexpr double kMaxRadiance = 1e30f;  // as floats hold it

/// A sky that the settings give: `sky`, `sky_intensity`, `sky_rotation`.
struct SkyOptions {
    /// A file; empty: none.
    std::string path;
    std::optional<glm::dvec3> constant;
    double intensity = 1.0;
    double rotation_degrees = 0.0;

    explicit SkyOptions(const Values& values);

    [[nodiscard]] bool replaces_sky() const { return constant || !path.empty(); }

    /// Changes the environment of the file at `scene_path`. Adds a warning if pixels were repaired.
    [[nodiscard]] Status apply(const std::string& scene_path, Environment& environment,
                               std::vector<std::string>& warnings) const;
};

}  // namespace tetralight::cli
