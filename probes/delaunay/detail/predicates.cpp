// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/delaunay/detail/predicates.h>

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>

namespace tetralight::detail {
namespace {

using glm::dvec3;

bool is_before(const dvec3& a, const dvec3& b) {
    if (a.x != b.x) return a.x < b.x;
    if (a.y != b.y) return a.y < b.y;
    return a.z < b.z;
}

}  // namespace

void DelaunayPredicates::include(std::span<const dvec3> positions) {
    for (const dvec3& position : positions) {
        box_ = union_of(box_, position);
        for (int axis = 0; axis < 3; ++axis) exponents_.include(position[axis]);
    }
    const dvec3 size = box_.max - box_.min;
    orientation_error_ = orientation_error(size);
    in_sphere_error_ = in_sphere_error(size);
    constexpr double kMostUnits = 0x1p24;
    const bool is_scalable = exponents_.lowest > -1000 && exponents_.lowest < 1000;
    const double per_unit = is_scalable ? std::ldexp(1.0, -exponents_.lowest) : 0.0;
    per_unit_ = std::max({size.x, size.y, size.z}) * per_unit <= kMostUnits ? per_unit : 0.0;
}

int DelaunayPredicates::close_orientation(const dvec3& a, const dvec3& b, const dvec3& c,
                                          const dvec3& d) const {
    return per_unit_ > 0.0 ? small_orientation(a, b, c, d, per_unit_)
                           : exact_orientation(a, b, c, d);
}

int DelaunayPredicates::close_in_sphere(const Positions& positions, bool is_zero) const {
    const auto& [a, b, c, d, e] = positions;
    int sign = 0;
    if (!is_zero) {
        sign = per_unit_ > 0.0 ? small_in_sphere(*a, *b, *c, *d, *e, per_unit_)
                               : exact_in_sphere(*a, *b, *c, *d, *e);
    }
    return sign != 0 ? sign : perturbed_in_sphere(positions);
}

/// Moving a corner outwards leaves e inside if e is on the corner's side of the other three; moving
/// e leaves it outside. The first move that decides is the greatest.
int DelaunayPredicates::perturbed_in_sphere(Positions positions) const {
    const dvec3* const e = positions[4];
    std::array<bool, 5> is_done{};
    for (int tries = 0; tries < 5; ++tries) {
        int greatest = -1;
        for (int i = 0; i < 5; ++i) {
            if (is_done[i]) continue;
            if (greatest < 0 || is_before(*positions[greatest], *positions[i])) greatest = i;
        }
        if (greatest == 4) break;
        is_done[greatest] = true;
        Positions moved = positions;
        moved[greatest] = e;
        const int sign = orientation(*moved[0], *moved[1], *moved[2], *moved[3]);
        if (sign != 0) return sign;
    }
    return -1;
}

bool DelaunayPredicates::are_collinear(const dvec3& a, const dvec3& b, const dvec3& c) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto across = [&](const dvec3& p) { return glm::dvec2(p[axis], p[(axis + 1) % 3]); };
        if (exact_orientation(across(a), across(b), across(c)) != 0) return false;
    }
    return true;
}

}  // namespace tetralight::detail
