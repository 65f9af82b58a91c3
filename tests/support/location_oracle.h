// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include <tetralight/probes/delaunay/exact_signs.h>
#include <tetralight/probes/detail/cell_corners.h>
#include <tetralight/probes/locate.h>

namespace tetralight::test {

/// How far from the cell that was found a position may lie.
struct Miss {
    /// Metres; 0: exact predicates put the position into the cell.
    double distance = 0.0;
    /// What rounding is a share of: the size of the cell, seen from the position.
    double scale = 0.0;
    /// A step of the cell's stored positions.
    double float_step = 0.0;

    /// Whether rounding of weights to floats explains the distance, or rounding of probes: cells of
    /// probes that stand apart by less than steps of their floats fold over their neighbors, and
    /// what lies between may be in no cell.
    [[nodiscard]] bool is_rounding() const { return distance <= 0x1p-22 * scale + float_step; }

    [[nodiscard]] double share() const { return distance > 0.0 ? distance / scale : 0.0; }
};

/// Knows where positions are without walking, and without the arithmetic that queries use.
class LocationOracle {
  public:
    explicit LocationOracle(const ProbeVolumeView& volume) : volume_(volume) {}

    /// Tetrahedra are tested by exact orientations of the stored float positions. In any other cell
    /// the weights must give the position back, on the cell's face or along its rays.
    [[nodiscard]] Miss measure(const glm::vec3& position, const CellLocation& location) const {
        const glm::dvec3 p = detail::local_position(volume_.info, position);
        if (location.cell >= volume_.cells.size()) {
            return {std::numeric_limits<double>::infinity(), 1.0, 0.0};
        }
        if (volume_.info.dimension == Dimension::Point) return {};
        Miss miss = rebuild(p, location);
        if (is_inside_tetrahedron(p, location.cell)) miss.distance = 0.0;
        return miss;
    }

  private:
    using Vector = glm::vec<3, long double>;

    [[nodiscard]] glm::dvec3 corner(uint32_t cell, int i) const {
        return glm::dvec3(volume_.positions[volume_.cells[cell].vertices[i]]);
    }

    [[nodiscard]] bool is_inside_tetrahedron(const glm::dvec3& p, uint32_t cell) const {
        if (volume_.info.dimension != Dimension::Space) return false;
        if (cell >= volume_.info.inner_cell_count) return false;
        for (int i = 0; i < 4; ++i) {
            std::array<glm::dvec3, 4> corners;
            for (int k = 0; k < 4; ++k) corners[k] = k == i ? p : corner(cell, k);
            const auto& [a, b, c, d] = corners;
            if (exact_orientation(a, b, c, d) < 0) return false;
        }
        return true;
    }

    /// Distance from the position to what its weights say: a point of the cell's face, moved along
    /// the rays for as far as the position asks for.
    [[nodiscard]] Miss rebuild(const glm::dvec3& p, const CellLocation& location) const {
        Miss miss;
        const bool is_inner = location.cell < volume_.info.inner_cell_count;
        const int count = cell_vertex_count(volume_.info.dimension) - (is_inner ? 0 : 1);
        Vector face(0.0L), ray(0.0L);
        long double sum = 0.0L;
        for (int i = 0; i < count; ++i) sum += static_cast<long double>(location.weights[i]);
        for (int i = 0; i < count; ++i) {
            const long double w = static_cast<long double>(location.weights[i]) / sum;
            const glm::dvec3 v = corner(location.cell, i);
            miss.scale = std::max(miss.scale, glm::distance(v, p));
            miss.float_step = std::max(miss.float_step, 0x1p-23 * glm::length(v));
            face += w * Vector(v);
            if (!is_inner) {
                ray +=
                    w *
                    Vector(
                        volume_.hull_rays[location.cell - volume_.info.inner_cell_count].rays[i]);
            }
        }
        const Vector away = across_axis(Vector(p) - face);
        const Vector along = across_axis(ray);
        const long double square = glm::dot(along, along);
        const long double t = square > 0 ? std::max(0.0L, glm::dot(away, along) / square) : 0.0L;
        miss.distance = static_cast<double>(glm::length(away - t * along));
        miss.scale += static_cast<double>(t);  // rays are unit vectors, and may be opposite ones
        return miss;
    }

    /// What is left of a vector where the volume looks: in its plane, along its line.
    [[nodiscard]] Vector across_axis(const Vector& v) const {
        const Vector axis(volume_.info.axis);
        const Vector along = axis * glm::dot(v, axis);
        if (volume_.info.dimension == Dimension::Plane) return v - along;
        return volume_.info.dimension == Dimension::Line ? along : v;
    }

    const ProbeVolumeView& volume_;
};

}  // namespace tetralight::test
