// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/walk_reach.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>

#include <tetralight/probes/detail/hull_cell.h>

namespace tetralight {
namespace {

/// More than rounding makes of a signed volume, as a factor of the cube of the longest difference.
constexpr double kVolumeRounding = 1e-12;

/// Weights in a hull cell change little in a box the size of a voxel; between the positions that
/// are tested they may be this much smaller.
constexpr double kHullTolerance = 0.05;

/// A tetrahedron of a smaller volume, in cubes of its longest edge, has a circumsphere that
/// rounding of its float positions changes much.
constexpr double kFlat = 1e-5;

/// What float positions may add to the power of a position, in squares of the diagonal of a box of
/// the size of a voxel: many times what they do.
constexpr double kPowerSlack = 1.0;

/// A walk leaves a tetrahedron by the face with the least signed volume, up to rounding of single
/// precision, in cubes of the longest difference.
constexpr double kChoiceRounding = 1e-5;

/// If more cells may be visited on the way to a box, its eighths are followed one by one.
constexpr size_t kManyCells = 64;

/// Of each eighth, or of an unbounded box, at most about so many cells are listed, those of the
/// fewest steps.
constexpr size_t kMostCells = 128;

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

    CornerPlane() = default;

    CornerPlane(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
        : normal(glm::cross(b - a, c - a)), point(a) {}

    /// True if a part of the box lies beyond the plane, or so near that rounding could say so.
    [[nodiscard]] bool may_be_passed(const Box<glm::dvec3>& box, double farthest) const {
        const double rounding = kVolumeRounding * farthest * farthest * farthest;
        return largest_along(box, normal, point) > -rounding;
    }
};

/// The largest signed volume beyond one plane less that beyond another, over a box.
double largest_excess(const Box<glm::dvec3>& box, const CornerPlane& plane,
                      const CornerPlane& other) {
    if (!is_bounded(box)) return std::numeric_limits<double>::infinity();
    const glm::dvec3 middle = box.center();
    const double at_middle =
        glm::dot(plane.normal, middle - plane.point) - glm::dot(other.normal, middle - other.point);
    return at_middle + 0.5 * glm::dot(glm::abs(plane.normal - other.normal), box.size());
}

double farthest_corner(const Box<glm::dvec3>& box, const TetraCorners& corners, size_t count) {
    double farthest = 0.0;
    for (size_t i = 0; i < count; ++i) {
        farthest = std::max(farthest, farthest_difference(box, corners[i]));
        farthest = std::max(farthest, glm::length(corners[i] - corners[0]));
    }
    return farthest;
}

/// The circumsphere of a tetrahedron.
struct Sphere {
    glm::dvec3 center{0.0};
    double square = 0.0;    ///< of its radius
    bool is_known = false;  ///< false: the tetrahedron is too flat
};

Sphere circumsphere(const TetraCorners& corners) {
    const glm::dvec3 b = corners[1] - corners[0];
    const glm::dvec3 c = corners[2] - corners[0];
    const glm::dvec3 d = corners[3] - corners[0];
    const double determinant = glm::dot(b, glm::cross(c, d));
    const double bb = glm::dot(b, b), cc = glm::dot(c, c), dd = glm::dot(d, d);
    const double longest = std::max({bb, cc, dd});
    if (!(std::abs(determinant) > kFlat * longest * std::sqrt(longest))) return {};
    const glm::dvec3 to_center =
        (bb * glm::cross(c, d) + cc * glm::cross(d, b) + dd * glm::cross(b, c)) /
        (2.0 * determinant);
    return {corners[0] + to_center, glm::dot(to_center, to_center), true};
}

/// The least |p − a.center|² − a.square − (|p − b.center|² − b.square) over a box, which is linear
/// in p. Minus infinity if it is not known.
double least_power_difference(const Sphere& a, const Sphere& b, const Box<glm::dvec3>& box) {
    if (!a.is_known || !b.is_known || !is_bounded(box)) {
        return -std::numeric_limits<double>::infinity();
    }
    const glm::dvec3 middle = box.center();
    const glm::dvec3 to_a = middle - a.center;
    const glm::dvec3 to_b = middle - b.center;
    const glm::dvec3 slope = glm::abs(b.center - a.center);
    const double at_middle = (glm::dot(to_a, to_a) - a.square) - (glm::dot(to_b, to_b) - b.square);
    return at_middle - glm::dot(slope, box.size());  // 2 slope · half of the size
}

/// Numbers of passes over cells, so that nothing has to be cleared between them.
void next_number(uint32_t& number, std::vector<uint32_t>& last) {
    if (++number != 0) return;
    std::ranges::fill(last, 0);
    number = 1;
}

constexpr size_t kNoFace = 4;

/// The faces by which walks to positions of a box may leave a tetrahedron, then kNoFace.
std::array<size_t, 5> passed_faces(const TetraCorners& corners, const Box<glm::dvec3>& region) {
    std::array<CornerPlane, 4> planes;
    for (size_t face = 0; face < 4; ++face) {
        const auto& [a, b, c] = kOutwardFaces[face];
        planes[face] = CornerPlane(corners[static_cast<size_t>(a)], corners[static_cast<size_t>(b)],
                                   corners[static_cast<size_t>(c)]);
    }
    const double farthest = farthest_corner(region, corners, 4);
    const double rounding = kChoiceRounding * farthest * farthest * farthest;
    std::array<size_t, 5> faces{};
    size_t count = 0;
    for (size_t face = 0; face < 4; ++face) {
        if (!planes[face].may_be_passed(region, farthest)) continue;
        // Another face that all of the box lies farther beyond is taken instead.
        const bool is_never_least = std::ranges::any_of(planes, [&](const CornerPlane& other) {
            return largest_excess(region, planes[face], other) < -rounding;
        });
        if (!is_never_least) faces[count++] = face;
    }
    faces[count] = kNoFace;
    return faces;
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
    : volume_(volume),
      listed_(volume.cells.size(), 0),
      visited_(volume.cells.size(), 0),
      reached_(volume.cells.size(), 0) {}

std::span<const uint32_t> WalkReach::cells_from(uint32_t start, const Box<glm::dvec3>& region) {
    next_number(call_, listed_);
    cells_.clear();
    follow(start, region);
    return cells_;
}

void WalkReach::follow(uint32_t start, const Box<glm::dvec3>& region) {
    if (!is_bounded(region)) return list_walks(start, region);
    if (walk_all(start, region, kManyCells)) return list_visits();
    for (int part = 0; part < 8; ++part) {
        Box<glm::dvec3> eighth = region;
        for (int axis = 0; axis < 3; ++axis) {
            const bool is_upper = (part >> axis & 1) != 0;
            (is_upper ? eighth.min : eighth.max)[axis] = region.center()[axis];
        }
        list_walks(start, eighth);
    }
}

void WalkReach::list_walks(uint32_t start, const Box<glm::dvec3>& region) {
    (void)walk_all(start, region, kMostCells);
    list_visits();
}

void WalkReach::list_visits() {
    for (const uint32_t cell : visits_) {
        if (listed_[cell] == call_) continue;
        listed_[cell] = call_;
        cells_.push_back(cell);
    }
}

void WalkReach::visit(uint32_t cell) {
    if (visited_[cell] == pass_) return;
    visited_[cell] = pass_;
    visits_.push_back(cell);
    if (cell >= volume_.info.inner_cell_count) hull_cells_.push_back(cell);
}

void WalkReach::enter(uint32_t tetrahedron) {
    if (std::ranges::find(entries_, tetrahedron) == entries_.end()) entries_.push_back(tetrahedron);
}

/// False: there are more cells than the limit.
bool WalkReach::walk_all(uint32_t start, const Box<glm::dvec3>& region, size_t limit) {
    next_number(pass_, visited_);
    visits_.clear();
    hull_cells_.clear();
    entries_.clear();
    if (start < volume_.info.inner_cell_count) {
        enter(start);
    } else {
        visit(start);
    }
    size_t next_entry = 0;
    size_t next_hull_cell = 0;
    while (next_entry < entries_.size() || next_hull_cell < hull_cells_.size()) {
        if (next_entry < entries_.size()) {
            walk_inside(entries_[next_entry++], region, limit);
        } else {
            leave_hull_cell(hull_cells_[next_hull_cell++], region);
        }
        if (visits_.size() > limit) return false;
    }
    return true;
}

/// From one tetrahedron to others, until walks come to hull cells.
void WalkReach::walk_inside(uint32_t start, const Box<glm::dvec3>& region, size_t limit) {
    next_number(walk_, reached_);
    const Sphere first = circumsphere(corners_of(volume_, start, 4));
    const glm::dvec3 size = region.size();
    const double slack = kPowerSlack * glm::dot(size, size);
    queue_.assign(1, start);
    reached_[start] = walk_;
    for (size_t next = 0; next < queue_.size() && visits_.size() <= limit; ++next) {
        const uint32_t cell = queue_[next];
        visit(cell);
        const TetraCorners corners = corners_of(volume_, cell, 4);
        for (const size_t face : passed_faces(corners, region)) {
            if (face == kNoFace) break;
            const uint32_t neighbor = volume_.cells[cell].neighbors[face];
            if (neighbor >= volume_.info.inner_cell_count) {
                visit(neighbor);
                continue;
            }
            if (reached_[neighbor] == walk_) continue;
            reached_[neighbor] = walk_;
            const Sphere sphere = circumsphere(corners_of(volume_, neighbor, 4));
            if (least_power_difference(sphere, first, region) <= slack) queue_.push_back(neighbor);
        }
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
    if (may_enter) enter(neighbors[3]);
}

bool may_touch(const ProbeVolumeView& volume, uint32_t cell, const Box<glm::dvec3>& box) {
    const TetraCorners corners = corners_of(volume, cell, 4);
    auto bounds = Box<glm::dvec3>::empty();
    for (const glm::dvec3& corner : corners) bounds = union_of(bounds, corner);
    if (!all(lessThanEqual(bounds.min, box.max)) || !all(lessThanEqual(box.min, bounds.max))) {
        return false;
    }
    const double signed_volume = glm::dot(
        corners[1] - corners[0], glm::cross(corners[2] - corners[0], corners[3] - corners[0]));
    const double farthest = farthest_corner(box, corners, 4);
    // Float positions can turn a flat tetrahedron inside out.
    if (!(signed_volume > kVolumeRounding * farthest * farthest * farthest)) return true;
    for (const auto& [a, b, c] : kOutwardFaces) {
        // The side of the face that the tetrahedron is on.
        const CornerPlane inwards(corners[static_cast<size_t>(a)], corners[static_cast<size_t>(c)],
                                  corners[static_cast<size_t>(b)]);
        if (!inwards.may_be_passed(box, farthest)) return false;
    }
    return true;
}

}  // namespace tetralight
