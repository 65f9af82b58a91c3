// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace tetralight {

/// The random key of a probe: a hash of the seed and the bits of its canonical world position. It
/// does not depend on the index, so that adding probes changes no other probe.
[[nodiscard]] uint64_t probe_key(uint64_t seed, const glm::dvec3& position) noexcept;

/// Counter-based random numbers: number n is a hash of (key, stream, n).
class RandomStream {
  public:
    RandomStream(uint64_t key, uint64_t stream) noexcept;

    /// Uniform in [0, 1).
    [[nodiscard]] float next() noexcept;
    [[nodiscard]] glm::vec2 next2() noexcept;

  private:
    uint64_t state_;
};

/// Direction `i` of `count` evenly distributed directions over the sphere (spherical Fibonacci
/// lattice: Marques et al. 2013, "Spherical Fibonacci Point Sets for Illumination Integrals").
[[nodiscard]] glm::vec3 spherical_fibonacci(uint32_t i, uint32_t count) noexcept;

/// All `count` directions.
[[nodiscard]] std::vector<glm::vec3> spherical_fibonacci(uint32_t count);

/// A uniformly distributed random rotation (Shoemake 1992, "Uniform Random Rotations").
[[nodiscard]] glm::mat3 sample_rotation(RandomStream& random) noexcept;

/// A rotation whose last column is the unit vector `n`.
[[nodiscard]] glm::mat3 frame_around(glm::vec3 n) noexcept;

/// A direction in the hemisphere around a unit normal with density cos θ / π.
[[nodiscard]] glm::vec3 sample_cosine_hemisphere(glm::vec3 normal, glm::vec2 u) noexcept;
[[nodiscard]] float sample_cosine_hemisphere_pdf(glm::vec3 normal, glm::vec3 direction) noexcept;

/// A direction within the angle acos(`min_cosine`) of a unit axis, uniform by solid angle.
[[nodiscard]] glm::vec3 sample_cone(glm::vec3 axis, float min_cosine, glm::vec2 u) noexcept;
[[nodiscard]] float sample_cone_pdf(float min_cosine) noexcept;

/// A point of the unit disc perpendicular to a unit normal, uniform by area.
[[nodiscard]] glm::vec3 sample_disc_around(glm::vec3 normal, glm::vec2 u) noexcept;

}  // namespace tetralight
