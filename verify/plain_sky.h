// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/bake/scene/environment.h>
#include <tetralight/verify/pcg.h>

namespace tetralight {

/// Directions of a sky image, chosen among its pixels by their brightness and solid angle, so that
/// a sun in the image is found. A constant sky is found by chance.
class PlainSky {
  public:
    /// Keeps a reference.
    explicit PlainSky(const Environment& environment);

    /// True if there is nothing to choose by.
    [[nodiscard]] bool is_empty() const { return sums_.empty(); }

    [[nodiscard]] glm::vec3 sample(Pcg& random) const;

    /// Density of `sample` per steradian.
    [[nodiscard]] float pdf(glm::vec3 direction) const;

    [[nodiscard]] glm::vec3 radiance(glm::vec3 direction) const {
        return environment_radiance(environment_, direction);
    }

  private:
    /// The upper edge of a row of pixels as a cosine.
    [[nodiscard]] double row_edge(size_t row) const;
    [[nodiscard]] double pixel_solid_angle(size_t row) const;

    const Environment& environment_;
    /// Sum over the pixels up to and with each.
    std::vector<double> sums_;
};

}  // namespace tetralight
