// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "bake/scene/scene.h"
#include "lppv/lppv_grid.h"
#include "probes/probe_volume.h"

namespace tetralight::cli {

/// Which grid a proxy volume has, as options.
struct LppvGridOptions {
    std::string object;
    std::vector<double> bounds;  ///< empty, or low x, y, z and high x, y, z
    std::vector<uint64_t> resolution;
    LppvSettings settings;
    CLI::Option* object_option = nullptr;

    void add_to(CLI::App& command);

    /// The object's box; without an object the given one, else that of the probes, both along the
    /// world's axes.
    [[nodiscard]] Result<LppvGrid> make_grid(const Scene& scene,
                                             const ProbeVolumeView& volume) const;
};

}  // namespace tetralight::cli
