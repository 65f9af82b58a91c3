// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/cli/values.h>
#include <tetralight/lppv/lppv_grid.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight::cli {

/// Which grid a proxy volume has.
struct LppvGridOptions {
    std::string object;
    std::vector<double> bounds;       ///< empty, or minimum x, y, z and maximum x, y, z
    std::vector<double> orientation;  ///< empty, or a quaternion x, y, z, w
    std::vector<uint32_t> resolution;
    LppvSettings settings;

    /// Keeps a reference. Throws a `UsageError` if settings do not go together.
    explicit LppvGridOptions(const Values& values);

    /// A grid in the object's box; without an object in the given one, or in that of the probes,
    /// both along the world's axes unless rotated. An axis without thickness has one point. Throws
    /// a `UsageError` if the grid has too many points.
    [[nodiscard]] Result<LppvGrid> make_grid(const Scene& scene,
                                             const ProbeVolumeView& volume) const;

    /// One line for each axis that has fewer points than asked for because it has no thickness.
    [[nodiscard]] std::vector<std::string> warnings(const LppvGrid& grid) const;

  private:
    void check_usage() const;
    void check_spacing(const LppvGrid& grid) const;
    [[nodiscard]] Result<LppvGrid> make_grid(const LppvObject& wrapped,
                                             const LppvSettings& chosen) const;

    const Values* values_;
};

}  // namespace tetralight::cli
