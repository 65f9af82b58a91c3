// SPDX-License-Identifier: Apache-2.0
#include "probes/locate.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "probes/detail/hull_cell.h"

namespace tetralight {
namespace {

/// Weights of a position in one cell. Not normalized: in a tetrahedron they are signed volumes.
struct CellWeights {
    glm::dvec4 weights{0.0};
    /// Sums up to this may be rounding alone: the cell is a sliver that holds no position.
    double rounding = 0.0;

    [[nodiscard]] double sum() const { return weights.x + weights.y + weights.z + weights.w; }

    /// Smallest weight as a share of the sum: ≥ 0 inside the cell.
    [[nodiscard]] double inside_measure() const {
        const double total = sum();
        if (!(total > rounding)) return -std::numeric_limits<double>::infinity();
        return std::min({weights.x, weights.y, weights.z, weights.w}) / total;
    }

    [[nodiscard]] int most_negative() const {
        int lowest = 0;
        for (int i = 1; i < 4; ++i) {
            if (weights[i] < weights[lowest]) lowest = i;
        }
        return lowest;
    }
};

/// Some times the rounding of a determinant whose columns have length 1.
constexpr double kRounding = 1e-12;

double longest(const std::array<glm::dvec3, 4>& corners, int count) {
    double square = 0.0;
    for (int i = 0; i < count; ++i) square = std::max(square, glm::dot(corners[i], corners[i]));
    return std::sqrt(square);
}

CellWeights tetrahedron_weights(const std::array<glm::dvec3, 4>& corners) {
    const auto& [a, b, c, d] = corners;
    const glm::dvec3 cd = glm::cross(c, d);
    const glm::dvec3 ab = glm::cross(a, b);
    const double size = longest(corners, 4);
    return {{glm::dot(b, cd), -glm::dot(a, cd), glm::dot(d, ab), -glm::dot(c, ab)},
            kRounding * size * size * size};
}

/// Walks over the cells of one volume towards one position.
class Walk {
  public:
    Walk(const ProbeVolumeView& volume, glm::vec3 position)
        : volume_(volume), position_(glm::dvec3(position) - volume.info.world_origin) {
        // Far away only the direction matters; nearer, double can tell the hull's corners apart.
        const double farthest = kFarthestExtents * static_cast<double>(volume.info.extent);
        const double distance = glm::length(position_);
        if (farthest > 0.0 && distance > farthest) position_ *= farthest / distance;
    }

    /// The cell of the seed that comes next along the Hilbert curve.
    [[nodiscard]] uint32_t start_cell() const {
        const uint64_t index = volume_.info.seed_cube.index(position_);
        const auto next = std::ranges::lower_bound(volume_.seeds, index, {}, &Seed::hilbert_index);
        const uint32_t cell = next != volume_.seeds.end() ? next->cell
                              : volume_.seeds.empty()     ? 0u
                                                          : volume_.seeds.back().cell;
        return cell < volume_.cells.size() ? cell : 0u;
    }

    [[nodiscard]] CellLocation run(uint32_t start) const {
        uint32_t cell = start;
        uint32_t previous = kNoIndex;
        CellWeights previous_weights;
        for (uint32_t steps = step_limit(); steps > 0; --steps) {
            const auto weights = cell_weights(cell);
            if (!weights) return search_all();
            if (weights->inside_measure() >= 0) return finish(cell, *weights);
            const uint32_t next = volume_.cells[cell].neighbors[weights->most_negative()];
            if (next == previous) return settle(cell, *weights, previous, previous_weights);
            previous = cell;
            previous_weights = *weights;
            cell = next;
        }
        return search_all();
    }

  private:
    static constexpr double kFarthestExtents = 65536.0;

    /// Four times the steps of a random walk (2.5 n^(1/3), measured), so that only a cycle meets
    /// it.
    [[nodiscard]] uint32_t step_limit() const {
        return 64 + 10 * static_cast<uint32_t>(std::cbrt(volume_.cells.size()));
    }

    [[nodiscard]] bool is_inner(uint32_t cell) const {
        return cell < volume_.info.inner_cell_count;
    }

    /// Corners of a cell relative to the position. Every index is tested here, where it is used:
    /// the volume may be an unverified file.
    [[nodiscard]] bool find_corners(uint32_t index, std::array<glm::dvec3, 4>& corners) const {
        if (index >= volume_.cells.size() || volume_.info.dimension > Dimension::Space)
            return false;
        const int count = cell_vertex_count(volume_.info.dimension) - (is_inner(index) ? 0 : 1);
        for (int i = 0; i < count; ++i) {
            const uint32_t probe = volume_.cells[index].vertices[i];
            if (probe >= volume_.positions.size()) return false;
            corners[i] = glm::dvec3(volume_.positions[probe]) - position_;
        }
        return true;
    }

    [[nodiscard]] std::optional<CellWeights> cell_weights(uint32_t index) const {
        std::array<glm::dvec3, 4> corners{};
        if (!find_corners(index, corners)) return std::nullopt;
        if (is_inner(index)) return inner_weights(corners);
        const uint32_t hull_index = index - volume_.info.inner_cell_count;
        if (hull_index >= volume_.hull_rays.size()) return std::nullopt;
        return hull_weights(corners, volume_.hull_rays[hull_index]);
    }

    /// A triangle of a plane is a tetrahedron whose fourth corner is far away along the normal; a
    /// segment is one with two such corners.
    [[nodiscard]] CellWeights inner_weights(std::array<glm::dvec3, 4> corners) const {
        const glm::dvec3& axis = volume_.info.axis;
        switch (volume_.info.dimension) {
            case Dimension::Space:
                return tetrahedron_weights(corners);
            case Dimension::Plane: {
                const double size = longest(corners, 3);
                corners[3] = axis;
                const glm::dvec4 weights = tetrahedron_weights(corners).weights;
                return {{weights.x, weights.y, weights.z, 0.0}, kRounding * size * size};
            }
            case Dimension::Line:
                return {{glm::dot(corners[1], axis), -glm::dot(corners[0], axis), 0.0, 0.0}, 0.0};
            default:
                return {{1.0, 0.0, 0.0, 0.0}, 0.0};
        }
    }

    [[nodiscard]] CellWeights hull_weights(const std::array<glm::dvec3, 4>& corners,
                                           const HullCellRays& rays) const {
        constexpr CellWeights kGoOnInside{{0.0, 0.0, 0.0, -1.0}};
        switch (volume_.info.dimension) {
            case Dimension::Space: {
                const auto weights =
                    detail::hull_cell_weights({corners[0], corners[1], corners[2]}, rays);
                return weights ? CellWeights{{*weights, 0.0}} : kGoOnInside;
            }
            case Dimension::Plane: {
                const auto weights =
                    detail::hull_edge_weights({corners[0], corners[1]}, rays, volume_.info.axis);
                return weights ? CellWeights{{*weights, 0.0, 0.0}} : kGoOnInside;
            }
            default: {
                const bool is_beyond = glm::dot(corners[0], glm::dvec3(rays.rays[0])) <= 0.0;
                return is_beyond ? CellWeights{{1.0, 0.0, 0.0, 0.0}} : kGoOnInside;
            }
        }
    }

    /// Each of two neighbors sends the walk to the other. On their shared face that is rounding,
    /// and both answers are the same; anything else is a cycle.
    [[nodiscard]] CellLocation settle(uint32_t a, const CellWeights& in_a, uint32_t b,
                                      const CellWeights& in_b) const {
        constexpr double kTolerance = 1e-6;
        const bool is_in_a = in_a.inside_measure() >= in_b.inside_measure();
        const CellWeights& best = is_in_a ? in_a : in_b;
        if (best.inside_measure() < -kTolerance) return search_all();
        return finish(is_in_a ? a : b, best);
    }

    /// The fallback that cannot fail: the cell that comes nearest to holding the position.
    [[nodiscard]] CellLocation search_all() const {
        CellLocation best;
        double best_measure = -std::numeric_limits<double>::infinity();
        for (uint32_t cell = 0; cell < volume_.cells.size(); ++cell) {
            const auto weights = cell_weights(cell);
            if (!weights || !(weights->inside_measure() > best_measure)) continue;
            best_measure = weights->inside_measure();
            best = finish(cell, *weights);
        }
        return best;
    }

    [[nodiscard]] static CellLocation finish(uint32_t cell, const CellWeights& cell_weights) {
        const glm::dvec4 clamped = glm::max(cell_weights.weights, glm::dvec4(0.0));
        // + 0 turns -0 into 0.
        const glm::vec4 weights(clamped / (clamped.x + clamped.y + clamped.z + clamped.w) + 0.0);
        if (!std::isfinite(weights.x + weights.y + weights.z + weights.w)) return {};
        return {cell, weights};
    }

    const ProbeVolumeView& volume_;
    glm::dvec3 position_;
};

bool is_finite(glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

CellLocation locate(const ProbeVolumeView& volume, glm::vec3 position, uint32_t hint) noexcept {
    if (volume.cells.empty() || !is_finite(position)) return {};
    const Walk walk(volume, position);
    return walk.run(hint < volume.cells.size() ? hint : walk.start_cell());
}

}  // namespace tetralight
