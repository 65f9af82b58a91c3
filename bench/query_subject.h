// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include <tetralight/bench/harness.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight::bench {

/// A volume, and positions to query.
struct Subject {
    std::string name;
    ProbeVolume volume;
    /// Box of the probes.
    glm::vec3 min{0.0f};
    glm::vec3 max{0.0f};
    uint64_t seed = 100;

    /// New random positions, uniform in the probes' box grown by 10 %.
    [[nodiscard]] std::vector<glm::vec3> positions(size_t count);

    /// The same in Morton order.
    [[nodiscard]] std::vector<glm::vec3> sorted_positions(size_t count);
};

/// Gives a volume walls: about this share of its directed edges is blocked, all numbers are random.
void add_random_walls(ProbeVolume& volume, double blocked_share);

/// Uniform random probes in a box of 100 m.
[[nodiscard]] Subject make_random_subject(const std::string& name, size_t probe_count);

/// A rotated lattice, whose neighbors are coplanar up to rounding, with light that is not linear.
[[nodiscard]] Subject make_lattice_subject(const std::string& name, size_t probe_count);

/// A baked scene with the name "scene": that of the options with a lattice of about 20 000 probes,
/// else the courtyard with its own probes.
[[nodiscard]] Subject make_scene_subject(const Options& options);

}  // namespace tetralight::bench
