// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/lppv/lppv_grid.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight::cli {

/// Which grid a proxy volume has, as options.
struct LppvGridOptions {
    std::string object;
    std::vector<double> bounds;       ///< empty, or low x, y, z and high x, y, z
    std::vector<double> orientation;  ///< empty, or a quaternion x, y, z, w
    std::vector<uint32_t> resolution;
    LppvSettings settings;
    CLI::Option* object_option = nullptr;

    void add_to(CLI::App& command);

    /// What is wrong with the options whatever the data, as wrong usage.
    void check_usage() const;

    /// The object's box; without an object the given one, else that of the probes, both along the
    /// world's axes unless turned. An axis without thickness has one point. A grid that is too
    /// large for the box is wrong usage.
    [[nodiscard]] Result<LppvGrid> make_grid(const Scene& scene,
                                             const ProbeVolumeView& volume) const;

    /// One line for each axis that has fewer points than asked for, as it has no thickness.
    [[nodiscard]] std::vector<std::string> warnings(const LppvGrid& grid) const;

  private:
    [[nodiscard]] Result<LppvGrid> make_grid(const LppvObject& wrapped,
                                             const LppvSettings& chosen) const;
};

}  // namespace tetralight::cli
