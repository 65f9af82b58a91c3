// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <tetralight/bake/placement/sensor_errors.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// Lists of numbers by what they belong to.
using Lists = std::vector<std::vector<uint32_t>>;

/// The cells at each probe of a volume.
[[nodiscard]] Lists cells_of_probes(const ProbeVolume& volume);

/// The sensors in each cell, as indices into their errors.
[[nodiscard]] Lists sensors_of_cells(const ProbeVolume& volume,
                                     std::span<const SensorError> errors);

/// The probes at some cells, sorted, each once.
[[nodiscard]] std::vector<uint32_t> probes_of_cells(const ProbeVolume& volume,
                                                    std::span<const uint32_t> cells);

/// What numbers stand for: `names[number]` for each.
[[nodiscard]] std::vector<uint32_t> named(std::span<const uint32_t> numbers,
                                          std::span<const uint32_t> names);

}  // namespace tetralight
