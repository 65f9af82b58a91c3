// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <vector>

#include <tetralight/bake/placement/light_pool.h>
#include <tetralight/bake/placement/sensor_errors.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// Limits of one pass.
struct RemoveRule {
    /// Probes that remain at least.
    size_t min_probe_count = 4;
    /// The maximum sum of the costs of all sensors (`SensorError::cost`).
    double max_cost = 0.0;
    /// The maximum number of sensors that are not covered.
    size_t max_uncovered = std::numeric_limits<size_t>::max();
    /// The maximum fraction of the probes that one pass removes.
    double max_fraction = 0.125;
    uint32_t thread_count = 0;
};

/// The probes, and the errors of the sensors in their volume.
struct RemoveInput {
    std::span<const uint32_t> probes;  ///< indices in the pool
    std::span<const uint32_t> spaces;  ///< one for each probe
    const ProbeVolume& volume;         ///< of the probes
    std::span<const uint32_t> sensors;
    std::span<const SensorError> errors;  ///< one for each sensor
    /// True for probes that are not removed; indexed like the pool.
    const std::vector<bool>& is_protected;
};

/// Removes the probes without which the cost changes least (after Vardis et al. 2021,
/// "Illumination-driven light probe placement", with a queue in place of their search). The cost of
/// a removal is computed in the Delaunay tetrahedralization of the probe's neighbors, whose cells
/// replace those of the probe. Costs are reused in later passes for probes whose neighbors stay.
class ProbeRemover {
  public:
    /// Keeps references.
    explicit ProbeRemover(const SensorView& view) : view_(view) {}

    /// Forgets costs by an earlier scale.
    void set_scale(const ErrorScale& scale) {
        view_.scale = scale;
        costs_.clear();
    }

    /// Returns the probes that remain after one pass; all of them if none can be removed. Removes
    /// the cheapest first, but no two neighbors. Each space keeps probes that span what all of its
    /// probes span.
    [[nodiscard]] std::vector<uint32_t> pass(const RemoveInput& input, const RemoveRule& rule);

  private:
    /// The cost of removing one probe.
    struct Cost {
        uint64_t key = 0;  ///< of its neighbors and sensors
        double change = 0.0;
        int uncovered = 0;  ///< change of the number of sensors that are not covered
    };

    SensorView view_;
    std::map<uint32_t, Cost> costs_;
};

}  // namespace tetralight
