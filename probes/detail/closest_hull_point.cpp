// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/detail/closest_hull_point.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>

#include <tetralight/probes/detail/cell_corners.h>

namespace tetralight::detail {
namespace {

/// Where along the edge a → b the origin comes closest, 0..1.
double closest_on_edge(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 edge = b - a;
    const double square = glm::dot(edge, edge);
    return square > 0.0 ? std::clamp(-glm::dot(a, edge) / square, 0.0, 1.0) : 0.0;
}

/// Finds the point of the hull that is closest to the origin of its corners.
class Descent {
  public:
    Descent(const ProbeVolumeView& volume, const glm::dvec3& position)
        : volume_(volume),
          position_(position),
          corner_count_(cell_vertex_count(volume.info.dimension) - 1) {}

    std::optional<HullPoint> run(uint32_t start) {
        consider(start);
        if (best_.cell == kNoIndex) return std::nullopt;
        for (size_t step = 0; step < volume_.cells.size(); ++step) {
            const HullPoint before = best_;
            for (int i = 0; i < corner_count_; ++i) {
                if (before.weights[i] <= 0.0) consider(volume_.cells[before.cell].neighbors[i]);
            }
            consider_fan(before);
            if (best_.cell == before.cell) break;
        }
        return best_;
    }

  private:
    /// Takes the closest point of a cell's face if it is closer than the best so far.
    void consider(uint32_t cell) {
        constexpr double kCloser = 1.0 - 1e-12;
        std::array<glm::dvec3, 4> corners{};
        if (cell < volume_.info.inner_cell_count) return;
        if (!find_corners(volume_, cell, position_, corners)) return;
        if (volume_.info.dimension != Dimension::Space) flatten(corners);
        const auto [weights, square] = closest(corners);
        if (best_.cell != kNoIndex && !(square < best_square_ * kCloser)) return;
        best_ = {cell, weights, std::sqrt(square)};
        best_square_ = square;
    }

    /// The cells around a corner: edges alone do not lead past a corner that two of them share.
    void consider_fan(const HullPoint& around) {
        if (corner_count_ != 3) return;
        const auto& weights = around.weights;
        const int corner = weights.x >= 1.0 ? 0 : weights.y >= 1.0 ? 1 : weights.z >= 1.0 ? 2 : 3;
        if (corner == 3) return;
        const uint32_t vertex = volume_.cells[around.cell].vertices[corner];
        uint32_t cell = around.cell;
        for (size_t turn = 0; turn < volume_.cells.size(); ++turn) {
            const auto& vertices = volume_.cells[cell].vertices;
            const auto place = std::find(vertices.begin(), vertices.begin() + 3, vertex);
            const auto index = static_cast<size_t>(place - vertices.begin());
            if (index == 3) return;
            cell = volume_.cells[cell].neighbors[(index + 1) % 3];
            if (cell == around.cell || cell >= volume_.cells.size()) return;
            consider(cell);
        }
    }

    /// Seen along the normal of the plane, or at the foot on the line.
    void flatten(std::array<glm::dvec3, 4>& corners) const {
        const glm::dvec3& axis = volume_.info.axis;
        const bool is_plane = volume_.info.dimension == Dimension::Plane;
        for (int i = 0; i < corner_count_; ++i) {
            const glm::dvec3 along = axis * glm::dot(corners[i], axis);
            corners[i] = is_plane ? corners[i] - along : along;
        }
    }

    struct Closest {
        glm::dvec3 weights{0.0};
        double square = std::numeric_limits<double>::infinity();
    };

    [[nodiscard]] Closest closest(const std::array<glm::dvec3, 4>& corners) const {
        Closest best;
        const auto consider_weights = [&](const glm::dvec3& weights) {
            const glm::dvec3 point =
                weights.x * corners[0] + weights.y * corners[1] + weights.z * corners[2];
            const double square = glm::dot(point, point);
            if (square < best.square) best = {weights, square};
        };
        if (corner_count_ == 1) consider_weights({1.0, 0.0, 0.0});
        for (int i = 0; i < (corner_count_ == 3 ? 3 : corner_count_ - 1); ++i) {
            const int j = (i + 1) % corner_count_;
            const double fraction = closest_on_edge(corners[i], corners[j]);
            glm::dvec3 weights(0.0);
            weights[i] = 1.0 - fraction;
            weights[j] = fraction;
            consider_weights(weights);
        }
        if (corner_count_ == 3) {
            if (const auto foot = foot_weights(corners)) consider_weights(*foot);
        }
        return best;
    }

    /// Weights of the foot of the origin on a triangle's plane, if it lies in the triangle.
    [[nodiscard]] static std::optional<glm::dvec3> foot_weights(
        const std::array<glm::dvec3, 4>& corners) {
        const auto& [a, b, c, unused] = corners;
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        const double square = glm::dot(normal, normal);
        const glm::dvec3 weights(glm::dot(glm::cross(b, c), normal) / square,
                                 glm::dot(glm::cross(c, a), normal) / square,
                                 glm::dot(glm::cross(a, b), normal) / square);
        const bool is_inside = weights.x >= 0.0 && weights.y >= 0.0 && weights.z >= 0.0;
        return is_inside ? std::optional(weights) : std::nullopt;  // none, too, without an area
    }

    const ProbeVolumeView& volume_;
    glm::dvec3 position_;
    int corner_count_;
    HullPoint best_;
    double best_square_ = 0.0;
};

}  // namespace

std::optional<HullPoint> closest_hull_point(const ProbeVolumeView& volume,
                                            const glm::dvec3& position,
                                            uint32_t hull_cell) noexcept {
    return Descent(volume, position).run(hull_cell);
}

CellLocation clamp_to_hull(const ProbeVolumeView& volume, const glm::vec3& position,
                           const CellLocation& location, const OutsideHull& outside) noexcept {
    const bool is_outside =
        location.cell >= volume.info.inner_cell_count && location.cell < volume.cells.size();
    if (!is_outside) return location;
    const glm::dvec3 local = local_position(volume.info, position);
    const auto point = closest_hull_point(volume, local, location.cell);
    if (!point) return location;
    const double sum = point->weights.x + point->weights.y + point->weights.z;
    const glm::dvec3 weights = point->weights / sum + 0.0;  // -0 becomes 0
    CellLocation clamped{point->cell, 0.0f, glm::vec4(weights, 0.0)};
    if (outside.policy == OutsidePolicy::Ambient) {
        // Positions that `local_position` moved nearer count with their true distance.
        const double moved_by =
            glm::distance(glm::dvec3(position) - volume.info.world_origin, local);
        const double fraction =
            (point->distance + moved_by) / static_cast<double>(outside.fade_distance);
        clamped.ambient = static_cast<float>(std::min(1.0, fraction));
        clamped.weights *= 1.0f - clamped.ambient;
    }
    return clamped;
}

}  // namespace tetralight::detail
