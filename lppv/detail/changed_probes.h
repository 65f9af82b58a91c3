// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/probes/locate.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {

/// The cells and probes that light the points of a proxy volume.
struct LitBy {
    /// Cells that contain the points, with repetitions.
    std::vector<uint32_t> cells;
    /// Bounding box of their probes, in local positions.
    glm::vec3 min{0.0f};
    glm::vec3 max{0.0f};

    void assign(const ProbeVolumeView& probes, std::span<const CellLocation> locations);
};

/// Probes whose light changed. It compares bounding boxes first, so that volumes far from the
/// change cost little.
class ChangedProbes {
  public:
    /// Precondition: `changed` are indices of probes, unless `is_everything`.
    ChangedProbes(const ProbeVolumeView& probes, std::span<const uint32_t> changed,
                  bool is_everything);

    /// True if one of the probes lights a volume.
    [[nodiscard]] bool light(const LitBy& volume) const;

  private:
    [[nodiscard]] bool has_changed(uint32_t cell) const;

    const ProbeVolumeView& probes_;
    bool is_everything_;
    bool is_empty_ = true;
    glm::vec3 min_{0.0f};
    glm::vec3 max_{0.0f};
    std::vector<bool> is_changed_;
};

}  // namespace tetralight::detail
