// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include <tetralight/bake/placement/light_pool.h>
#include <tetralight/bake/placement/sensor_errors.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// How many probes may go.
struct RemoveRule {
    /// Not fewer probes than this are left.
    size_t min_probe_count = 4;
    /// The sum of all sensors' squares that may be reached.
    double max_square_sum = 0.0;
    /// Share of the probes that may go at once.
    double max_fraction = 0.125;
    uint32_t thread_count = 0;
};

/// What probes are removed from.
struct RemoveInput {
    std::span<const uint32_t> probes;  ///< by number in the pool
    std::span<const uint32_t> spaces;  ///< one a probe
    const ProbeVolume& volume;         ///< of the probes
    std::span<const uint32_t> sensors;
    std::span<const SensorError> errors;  ///< one a sensor
    /// Those that stay, by number in the pool.
    const std::vector<bool>& is_protected;
};

/// Takes away the probes without which the light changes least (after Vardis et al. 2021,
/// "Illumination-driven light probe placement", with a queue in place of their search): what a
/// removal costs is found in the Delaunay cells of the probe's neighbors alone, which are those
/// that fill its place. Costs are kept from pass to pass for probes whose neighbors stay.
class ProbeRemover {
  public:
    /// Keeps a reference.
    explicit ProbeRemover(const LightPool& pool) : pool_(pool) {}

    /// The probes that are left after one pass, the cheapest first, none beside another one that
    /// goes; all of them when nothing can go. Each space keeps probes that span what all of its
    /// probes span.
    [[nodiscard]] std::vector<uint32_t> pass(const RemoveInput& input, const RemoveRule& rule);

  private:
    /// Of one probe, by number in the pool.
    struct Cost {
        uint64_t key = 0;  ///< of its neighbors and sensors
        double change = 0.0;
    };

    const LightPool& pool_;
    std::map<uint32_t, Cost> costs_;
};

}  // namespace tetralight
