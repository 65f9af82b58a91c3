// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/random_probes.h"

namespace tetralight::test {

/// Positions that have led walks astray: on probes, edges and faces, exactly between probes, on the
/// hull and far beyond it, on the walls between hull cells, and the floats next to all these.
class AdversarialPositions {
  public:
    AdversarialPositions(const ProbeVolume& volume, uint64_t seed)
        : volume_(volume), engine_(seed) {
        if (volume.positions.empty()) return;
        low_ = high_ = glm::dvec3(volume.positions[0]);
        for (const glm::vec3& p : volume.positions) {
            low_ = glm::min(low_, glm::dvec3(p));
            high_ = glm::max(high_, glm::dvec3(p));
        }
    }

    glm::vec3 next() {
        const glm::vec3 position(local() + volume_.info.world_origin);
        return engine_() % 4 == 0 ? beside(position) : position;
    }

    std::vector<glm::vec3> make(size_t count) {
        std::vector<glm::vec3> positions(count);
        for (glm::vec3& position : positions) position = next();
        return positions;
    }

  private:
    double share() { return std::uniform_real_distribution(0.0, 1.0)(engine_); }

    glm::dvec3 local() {
        switch (engine_() % 6) {
            case 0: {
                const glm::dvec3 any(share(), share(), share());
                return glm::mix(low_, high_, 1.2 * any - 0.1);
            }
            case 1: {  // exactly between any two probes
                const auto probe = [&] {
                    return glm::dvec3(volume_.positions[engine_() % volume_.positions.size()]);
                };
                const glm::dvec3 first = probe();
                return 0.5 * (first + probe());
            }
            case 2: {  // near a probe
                const auto& probe = volume_.positions[engine_() % volume_.positions.size()];
                return glm::dvec3(probe) + size(-8.0, 0.0) * glm::dvec3(random_direction(engine_));
            }
            case 3:
                return beyond_hull();
            default:
                return in_cell();
        }
    }

    /// So many extents as a power of ten between these.
    double size(double low, double high) {
        return std::pow(10.0, std::uniform_real_distribution(low, high)(engine_)) *
               static_cast<double>(volume_.info.extent);
    }

    /// Convex weights of one to four corners; equal ones half of the time.
    glm::dvec4 weights(int corner_count) {
        glm::dvec4 weights(0.0);
        const bool is_middle = engine_() % 2 == 0;
        const auto first = static_cast<int>(engine_() % 4);
        const auto count = static_cast<int>(1 + engine_() % 4);
        for (int i = first; i < first + count; ++i) {
            weights[i % corner_count] = is_middle ? 1.0 : share();
        }
        return weights / (weights.x + weights.y + weights.z + weights.w);
    }

    /// In a cell, on one of its faces, edges or corners.
    glm::dvec3 in_cell() {
        const Cell& cell = volume_.cells[engine_() % volume_.cells.size()];
        const glm::dvec4 w = weights(corner_count(cell));
        glm::dvec3 sum(0.0);
        for (int i = 0; i < corner_count(cell); ++i) {
            sum += w[i] * glm::dvec3(volume_.positions[cell.vertices[i]]);
        }
        return sum;
    }

    /// In a hull cell or on its walls, up to 1e4 extents away.
    glm::dvec3 beyond_hull() {
        if (volume_.hull_rays.empty()) return in_cell();
        const size_t index = engine_() % volume_.hull_rays.size();
        const Cell& cell = volume_.cells[volume_.info.inner_cell_count + index];
        const glm::dvec4 w = weights(corner_count(cell));
        const double distance = engine_() % 8 == 0 ? 0.0 : size(-8.0, 4.0);
        glm::dvec3 sum(0.0);
        for (int i = 0; i < corner_count(cell); ++i) {
            sum += w[i] * (glm::dvec3(volume_.positions[cell.vertices[i]]) +
                           distance * glm::dvec3(volume_.hull_rays[index].rays[i]));
        }
        return sum;
    }

    static int corner_count(const Cell& cell) {
        int count = 0;
        while (count < 4 && cell.vertices[count] != kNoIndex) ++count;
        return count;
    }

    /// The next float on one axis.
    glm::vec3 beside(glm::vec3 position) {
        const auto axis = static_cast<int>(engine_() % 3);
        const float far = std::numeric_limits<float>::infinity();
        position[axis] = std::nextafter(position[axis], engine_() % 2 == 0 ? far : -far);
        return position;
    }

    const ProbeVolume& volume_;
    std::mt19937_64 engine_;
    glm::dvec3 low_{0.0};
    glm::dvec3 high_{0.0};
};

}  // namespace tetralight::test
