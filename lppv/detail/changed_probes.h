// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/probes/locate.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {

/// What lights the points of a proxy volume.
struct LitBy {
    /// Cells that the points lie in; some may stand there twice.
    std::vector<uint32_t> cells;
    /// Box of the probes of those, local positions.
    glm::vec3 low{0.0f};
    glm::vec3 high{0.0f};

    void assign(const ProbeVolumeView& probes, std::span<const CellLocation> locations);
};

/// Probes whose light changed. Asks first whether boxes meet, so that volumes far from the change
/// cost nearly nothing.
class ChangedProbes {
  public:
    /// Precondition: `changed` are indices of probes, unless everything changed.
    ChangedProbes(const ProbeVolumeView& probes, std::span<const uint32_t> changed,
                  bool is_everything);

    /// Whether one of them lights a volume.
    [[nodiscard]] bool light(const LitBy& volume) const;

  private:
    [[nodiscard]] bool has_changed(uint32_t cell) const;

    const ProbeVolumeView& probes_;
    bool is_everything_;
    bool is_empty_ = true;
    glm::vec3 low_{0.0f};
    glm::vec3 high_{0.0f};
    std::vector<bool> is_changed_;
};

}  // namespace tetralight::detail
