// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/bench/harness.h>
#include <tetralight/bench/leak_volume.h>

// The parts of `bench leaks`.

namespace tetralight::bench {

/// Random positions in the two rooms.
struct RoomPositions {
    std::vector<glm::vec3> lit, dark;
    /// Those of the lit room up to 0.6 m from the wall.
    std::vector<glm::vec3> near;

    explicit RoomPositions(float thickness);
};

/// Two rooms with walls of 20 cm, 5 cm and none.
void bench_leak_rooms(const Options& options);

/// A proxy volume over both rooms. `name`: the last part of the figures' names.
void bench_leak_lppv(const LeakVolume& volume, const RoomPositions& positions, float thickness,
                     const std::string& name);

/// A house with a door, the inside of the courtyard's house, and the scene of the options: errors
/// against path-traced light.
void bench_leak_places(const Options& options);

}  // namespace tetralight::bench
