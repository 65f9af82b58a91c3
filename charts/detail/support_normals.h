// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace tetralight::detail {

/// Those of a set of normals that reach farthest along some fixed directions. They stand for the
/// whole set where an answer may be wrong for a few: if no cone contains them, none contains the
/// set.
class SupportNormals {
  public:
    static constexpr size_t kCount = 14;

    /// Adds a unit vector, or a zero vector without effect.
    void add(const glm::dvec3& normal) {
        if (normal == glm::dvec3(0.0)) return;
        for (size_t i = 0; i < kCount; ++i) {
            if (glm::dot(normal, kDirections[i]) > glm::dot(normals_[i], kDirections[i]) ||
                normals_[i] == glm::dvec3(0.0)) {
                normals_[i] = normal;
            }
        }
    }

    void add(const SupportNormals& other) {
        for (const glm::dvec3& normal : other.normals_) add(normal);
    }

    /// The normals, some of them more than once; zero vectors if there are none.
    [[nodiscard]] const std::array<glm::dvec3, kCount>& normals() const { return normals_; }

  private:
    static constexpr std::array<glm::dvec3, kCount> kDirections{{{1, 0, 0},
                                                                 {-1, 0, 0},
                                                                 {0, 1, 0},
                                                                 {0, -1, 0},
                                                                 {0, 0, 1},
                                                                 {0, 0, -1},
                                                                 {1, 1, 1},
                                                                 {1, 1, -1},
                                                                 {1, -1, 1},
                                                                 {1, -1, -1},
                                                                 {-1, 1, 1},
                                                                 {-1, 1, -1},
                                                                 {-1, -1, 1},
                                                                 {-1, -1, -1}}};

    std::array<glm::dvec3, kCount> normals_{};
};

}  // namespace tetralight::detail
