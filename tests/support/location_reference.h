// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <span>

#include <tetralight/probes/locate.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight::test {

/// Weights of a position in a cell as long double gives them. They sum to 1.
struct ReferenceWeights {
    std::array<long double, 4> weights{};
    /// What rounding may have added to a weight: large in cells that are nearly flat.
    long double rounding = 0.0L;
    /// How far the position lies behind the face of a hull cell, as a share of the cell's size.
    long double behind = 0.0L;

    [[nodiscard]] long double least() const { return *std::ranges::min_element(weights); }
};

/// Computes weights as docs/conventions.md defines them, by determinants and bisection. Shares no
/// code with queries. For positions up to 65536 extents away.
class LocationReference {
  public:
    explicit LocationReference(const ProbeVolumeView& volume) : volume_(volume) {}

    /// None if the cell has no volume, or its moving face never meets the position.
    [[nodiscard]] std::optional<ReferenceWeights> weights(const glm::vec3& position,
                                                          uint32_t cell) const {
        const Vector local = Vector(position) - Vector(volume_.info.world_origin);
        const bool is_inner = cell < volume_.info.inner_cell_count;
        switch (volume_.info.dimension) {
            case Dimension::Space:
                return is_inner ? in_tetrahedron(local, cell) : in_hull_cell(local, cell);
            case Dimension::Plane:
                return is_inner ? in_triangle(local, cell) : in_hull_edge(local, cell);
            case Dimension::Line:
                return is_inner ? in_segment(local, cell) : in_hull_end(local, cell);
            default:
                return ReferenceWeights{{1, 0, 0, 0}};
        }
    }

    /// True if the weights of a hull cell are those of some position that rounds to the same
    /// floats: thin faces make much of less.
    [[nodiscard]] bool is_of_float(const glm::vec3& position, const CellLocation& location) const {
        const bool is_inner = location.cell < volume_.info.inner_cell_count;
        if (is_inner || volume_.info.dimension != Dimension::Space) return false;
        const Face f = face(location.cell, Vector(position) - Vector(volume_.info.world_origin), 3);
        Vector corner(0.0L), ray(0.0L);
        for (int i = 0; i < 3; ++i) {
            corner += static_cast<long double>(location.weights[i]) * f.corners[i];
            ray += static_cast<long double>(location.weights[i]) * f.rays[i];
        }
        const long double t = std::max(0.0L, -glm::dot(corner, ray) / glm::dot(ray, ray));
        const glm::vec3 size = glm::abs(position);
        const float largest = std::max({size.x, size.y, size.z});
        const float step =
            std::nextafter(largest, std::numeric_limits<float>::infinity()) - largest;
        return glm::length(corner + t * ray) <= static_cast<long double>(0.5f * step);
    }

  private:
    using Vector = glm::vec<3, long double>;
    static constexpr long double kEpsilon = std::numeric_limits<long double>::epsilon();

    /// A face of the hull `t` along its rays, relative to the position.
    struct Face {
        std::array<Vector, 3> corners{};
        std::array<Vector, 3> rays{};

        [[nodiscard]] Vector at(int i, long double t) const { return corners[i] + t * rays[i]; }
    };

    static long double determinant(const Vector& a, const Vector& b, const Vector& c) {
        return glm::dot(a, glm::cross(b, c));
    }

    [[nodiscard]] Vector corner(uint32_t cell, int i, const Vector& from) const {
        return Vector(volume_.positions[volume_.cells[cell].vertices[i]]) - from;
    }

    [[nodiscard]] Face face(uint32_t cell, const Vector& position, int count) const {
        Face made;
        for (int i = 0; i < count; ++i) {
            made.corners[i] = corner(cell, i, position);
            made.rays[i] = Vector(volume_.hull_rays[cell - volume_.info.inner_cell_count].rays[i]);
        }
        return made;
    }

    static long double longest(std::span<const Vector> vectors) {
        long double length = 0.0L;
        for (const Vector& v : vectors) length = std::max(length, glm::length(v));
        return length;
    }

    /// Parts of a sum whose rounding is below `error`.
    static std::optional<ReferenceWeights> normalized(const std::array<long double, 4>& parts,
                                                      long double error) {
        const long double sum = parts[0] + parts[1] + parts[2] + parts[3];
        if (!(sum > 0.0L)) return std::nullopt;
        ReferenceWeights made;
        for (size_t i = 0; i < 4; ++i) made.weights[i] = parts[i] / sum;
        made.rounding = 16.0L * error / sum;
        return made;
    }

    [[nodiscard]] std::optional<ReferenceWeights> in_tetrahedron(const Vector& position,
                                                                 uint32_t cell) const {
        std::array<Vector, 4> p;
        for (int i = 0; i < 4; ++i) p[i] = corner(cell, i, position);
        const long double size = longest(p);
        return normalized({determinant(p[1], p[2], p[3]), -determinant(p[0], p[2], p[3]),
                           determinant(p[0], p[1], p[3]), -determinant(p[0], p[1], p[2])},
                          kEpsilon * size * size * size);
    }

    /// The foot of a position on the plane of the probes.
    [[nodiscard]] Vector on_plane(const Vector& position) const {
        const Vector axis(volume_.info.axis);
        return position - axis * glm::dot(axis, position - Vector(volume_.positions[0]));
    }

    [[nodiscard]] std::optional<ReferenceWeights> in_triangle(const Vector& position,
                                                              uint32_t cell) const {
        const Vector axis(volume_.info.axis), foot = on_plane(position);
        std::array<Vector, 3> p;
        for (int i = 0; i < 3; ++i) p[i] = corner(cell, i, foot);
        const long double size = longest(p);
        const long double height = kEpsilon * glm::distance(position, foot);
        return normalized({determinant(axis, p[1], p[2]), determinant(axis, p[2], p[0]),
                           determinant(axis, p[0], p[1]), 0.0L},
                          kEpsilon * size * size + height * size);
    }

    [[nodiscard]] std::optional<ReferenceWeights> in_segment(const Vector& position,
                                                             uint32_t cell) const {
        const Vector axis(volume_.info.axis);
        const Vector a = corner(cell, 0, position), b = corner(cell, 1, position);
        return normalized({glm::dot(b, axis), -glm::dot(a, axis), 0.0L, 0.0L},
                          kEpsilon * (glm::length(a) + glm::length(b)));
    }

    /// The first t where `outside` is no longer positive, by bisection; 0 if it never was. A face
    /// that has no area, or looks inwards, may turn outwards as it grows. None if it stays positive
    /// up to 2²¹ sizes.
    template <class Outside>
    static std::optional<long double> first_root(const Outside& outside, long double size,
                                                 bool has_area) {
        long double low = 0.0L, high = 0x1p-60L * size;
        if (outside(0.0L) == 0.0L && has_area) return 0.0L;
        if (!(outside(0.0L) > 0.0L)) {
            while (high < 0x1p21L * size && !(outside(high) > 0.0L)) high *= 2.0L;
            if (!(outside(high) > 0.0L)) return 0.0L;
            low = high;
        }
        while (outside(high) > 0.0L) {
            low = high;
            high *= 1.5L;
            if (high > 0x1p21L * size) return std::nullopt;
        }
        for (int i = 0; i < 80; ++i) {
            const long double middle = 0.5L * (low + high);
            (outside(middle) > 0.0L ? low : high) = middle;
        }
        return high;
    }

    [[nodiscard]] std::optional<ReferenceWeights> in_hull_cell(const Vector& position,
                                                               uint32_t cell) const {
        const Face f = face(cell, position, 3);
        // The triangle is counter-clockwise from outside: from there the position sees its front.
        const auto outside = [&](long double t) {
            return -determinant(f.at(0, t), f.at(1, t), f.at(2, t));
        };
        const bool has_area = glm::length(glm::cross(f.corners[1] - f.corners[0],
                                                     f.corners[2] - f.corners[0])) > 0.0L;
        const auto t = first_root(outside, longest(f.corners), has_area);
        if (!t) return std::nullopt;
        const Vector a = f.at(0, *t), b = f.at(1, *t), c = f.at(2, *t);
        const Vector normal = glm::cross(b - a, c - a);
        const std::array<Vector, 5> lengths{a, b, c, b - a, c - a};
        const long double size = longest(lengths) + *t;
        const long double area = glm::length(normal);
        auto made =
            normalized({glm::dot(glm::cross(b, c), normal), glm::dot(glm::cross(c, a), normal),
                        glm::dot(glm::cross(a, b), normal), 0.0L},
                       kEpsilon * size * size * area);
        if (made && *t == 0.0L) made->behind = glm::dot(a, normal) / (area * size);
        return made;
    }

    [[nodiscard]] std::optional<ReferenceWeights> in_hull_edge(const Vector& position,
                                                               uint32_t cell) const {
        const Vector axis(volume_.info.axis), foot = on_plane(position);
        const Face f = face(cell, foot, 2);
        const auto outside = [&](long double t) {
            return -determinant(f.at(0, t), f.at(1, t), axis);
        };
        const auto t = first_root(outside, longest(std::span(f.corners).first(2)), true);
        if (!t) return std::nullopt;
        const auto flat = [&](const Vector& v) { return v - axis * glm::dot(axis, v); };
        const Vector a = flat(f.at(0, *t)), b = flat(f.at(1, *t)), edge = b - a;
        const long double height = glm::distance(position, foot);
        auto made = normalized(
            {glm::dot(b, edge), -glm::dot(a, edge), 0.0L, 0.0L},
            kEpsilon * (glm::length(a) + glm::length(b) + *t + height) * glm::length(edge));
        if (made && *t == 0.0L) {
            const long double size = glm::length(a) + glm::length(b);
            made->behind = determinant(a, b, axis) / (glm::length(edge) * size);
        }
        return made;
    }

    [[nodiscard]] std::optional<ReferenceWeights> in_hull_end(const Vector& position,
                                                              uint32_t cell) const {
        const Face f = face(cell, position, 1);
        ReferenceWeights made{{1, 0, 0, 0}};
        const long double behind = glm::dot(f.corners[0], f.rays[0]);
        made.behind = behind > 0.0L ? behind / glm::length(f.corners[0]) : 0.0L;
        return made;
    }

    ProbeVolumeView volume_;
};

}  // namespace tetralight::test
