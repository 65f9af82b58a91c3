// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/walk_reach.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <tetralight/probes/detail/hull_cell.h>

namespace tetralight {
namespace {

/// More than rounding makes of a signed volume, as a factor of the cube of the longest difference.
constexpr double kVolumeRounding = 1e-12;

/// Weights in a hull cell change little in a box the size of a voxel; between the positions that
/// are tested they may be this much smaller.
constexpr double kHullTolerance = 0.05;

using TetraCorners = std::array<glm::dvec3, 4>;

TetraCorners corners_of(const ProbeVolumeView& volume, uint32_t cell, size_t count) {
    TetraCorners corners{};
    for (size_t i = 0; i < count; ++i) {
        corners[i] = glm::dvec3(volume.positions[volume.cells[cell].vertices[i]]);
    }
    return corners;
}

bool is_bounded(const Box<glm::dvec3>& box) {
    const glm::dvec3 size = box.size();
    return std::isfinite(size.x) && std::isfinite(size.y) && std::isfinite(size.z);
}

/// The largest difference of coordinates between a box and a point; infinite ends do not count.
double farthest_difference(const Box<glm::dvec3>& box, const glm::dvec3& point) {
    double farthest = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double end : {box.min[axis], box.max[axis]}) {
            if (std::isfinite(end)) farthest = std::max(farthest, std::abs(end - point[axis]));
        }
    }
    return farthest;
}

/// The largest dot(normal, p − point) over a box.
double largest_along(const Box<glm::dvec3>& box, const glm::dvec3& normal,
                     const glm::dvec3& point) {
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        if (normal[axis] == 0.0) continue;
        const double end = normal[axis] > 0.0 ? box.max[axis] : box.min[axis];
        sum += normal[axis] * (end - point[axis]);
    }
    return sum;
}

/// A plane through three corners, with the side that its normal points to.
struct CornerPlane {
    glm::dvec3 normal{0.0};
    glm::dvec3 point{0.0};

    CornerPlane(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
        : normal(glm::cross(b - a, c - a)), point(a) {}

    /// True if a part of the box lies beyond the plane, or so near that rounding could say so.
    [[nodiscard]] bool may_be_passed(const Box<glm::dvec3>& box, double farthest) const {
        const double rounding = kVolumeRounding * farthest * farthest * farthest;
        return largest_along(box, normal, point) > -rounding;
    }
};

double farthest_corner(const Box<glm::dvec3>& box, const TetraCorners& corners, size_t count) {
    double farthest = 0.0;
    for (size_t i = 0; i < count; ++i) {
        farthest = std::max(farthest, farthest_difference(box, corners[i]));
        farthest = std::max(farthest, glm::length(corners[i] - corners[0]));
    }
    return farthest;
}

/// The corners of a box and its center.
std::array<glm::dvec3, 9> tested_positions(const Box<glm::dvec3>& box) {
    std::array<glm::dvec3, 9> positions;
    for (int i = 0; i < 8; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            positions[static_cast<size_t>(i)][axis] =
                (i >> axis & 1) != 0 ? box.max[axis] : box.min[axis];
        }
    }
    positions[8] = box.center();
    return positions;
}

}  // namespace

WalkReach::WalkReach(const ProbeVolumeView& volume)
    : volume_(volume), visited_(volume.cells.size(), 0) {}

void WalkReach::visit(uint32_t cell) {
    if (visited_[cell] == call_) return;
    visited_[cell] = call_;
    cells_.push_back(cell);
}

std::span<const uint32_t> WalkReach::cells_from(uint32_t start, const Box<glm::dvec3>& region) {
    if (++call_ == 0) {
        std::ranges::fill(visited_, 0);
        call_ = 1;
    }
    cells_.clear();
    visit(start);
    for (size_t next = 0; next < cells_.size(); ++next) {
        const uint32_t cell = cells_[next];
        if (cell < volume_.info.inner_cell_count) {
            leave_tetrahedron(cell, region);
        } else {
            leave_hull_cell(cell, region);
        }
    }
    return cells_;
}

void WalkReach::leave_tetrahedron(uint32_t cell, const Box<glm::dvec3>& region) {
    const TetraCorners corners = corners_of(volume_, cell, 4);
    const double farthest = farthest_corner(region, corners, 4);
    for (size_t face = 0; face < 4; ++face) {
        const auto& [a, b, c] = kOutwardFaces[face];
        const CornerPlane plane(corners[static_cast<size_t>(a)], corners[static_cast<size_t>(b)],
                                corners[static_cast<size_t>(c)]);
        if (plane.may_be_passed(region, farthest)) visit(volume_.cells[cell].neighbors[face]);
    }
}

void WalkReach::leave_hull_cell(uint32_t cell, const Box<glm::dvec3>& region) {
    if (!is_bounded(region)) return;
    const TetraCorners corners = corners_of(volume_, cell, 3);
    const auto& neighbors = volume_.cells[cell].neighbors;
    const CornerPlane behind(corners[0], corners[2], corners[1]);
    bool may_enter = behind.may_be_passed(region, farthest_corner(region, corners, 3));
    std::array<bool, 3> may_leave{};
    const HullCellRays& rays = volume_.hull_rays[cell - volume_.info.inner_cell_count];
    for (const glm::dvec3& position : tested_positions(region)) {
        const auto weights = detail::hull_cell_weights(
            detail::make_hull_triangle({corners[0], corners[1], corners[2]}, position), rays);
        if (!weights) may_enter = true;
        for (int side = 0; side < 3 && weights; ++side) {
            if ((*weights)[side] < kHullTolerance) may_leave[static_cast<size_t>(side)] = true;
        }
    }
    for (size_t side = 0; side < 3; ++side) {
        if (may_leave[side]) visit(neighbors[side]);
    }
    if (may_enter) visit(neighbors[3]);
}

bool may_touch(const ProbeVolumeView& volume, uint32_t cell, const Box<glm::dvec3>& box) {
    const TetraCorners corners = corners_of(volume, cell, 4);
    auto bounds = Box<glm::dvec3>::empty();
    for (const glm::dvec3& corner : corners) bounds = union_of(bounds, corner);
    if (!all(lessThanEqual(bounds.min, box.max)) || !all(lessThanEqual(box.min, bounds.max))) {
        return false;
    }
    const double volume = glm::dot(corners[1] - corners[0],
                                   glm::cross(corners[2] - corners[0], corners[3] - corners[0]));
    const double farthest = farthest_corner(box, corners, 4);
    // Float positions can turn a flat tetrahedron inside out.
    if (!(volume > kVolumeRounding * farthest * farthest * farthest)) return true;
    for (const auto& [a, b, c] : kOutwardFaces) {
        // The side of the face that the tetrahedron is on.
        const CornerPlane inwards(corners[static_cast<size_t>(a)], corners[static_cast<size_t>(c)],
                                  corners[static_cast<size_t>(b)]);
        if (!inwards.may_be_passed(box, farthest)) return false;
    }
    return true;
}

}  // namespace tetralight
