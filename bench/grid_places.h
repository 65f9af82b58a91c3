// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include <tetralight/bench/grid_scenes.h>

namespace tetralight::bench {

/// An endless sequence of random places, drawn without the generator, that bodies reach from the
/// subject's seeds (without seeds: in the largest space that light reaches). They are at least 5 cm
/// off all surfaces: half of them 5 to 25 cm off one, distributed by area, the others uniform in
/// the volume.
class ReachablePlaces {
  public:
    /// Keeps a reference.
    explicit ReachablePlaces(const GridSubject& subject);
    ~ReachablePlaces();

    /// The next places, an even number of at least `count`.
    [[nodiscard]] std::vector<glm::dvec3> next(size_t count);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace tetralight::bench
