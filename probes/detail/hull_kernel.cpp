// SPDX-License-Identifier: Apache-2.0
// Compiled once for each kind of processor: Highway includes this file again and again.
#include <tetralight/probes/detail/vector_kernels.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE <tetralight/probes/detail/hull_kernel.cpp>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <tetralight/probes/detail/hull_cell.h>

HWY_BEFORE_NAMESPACE();

namespace tetralight::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, HullLanes::kCount>;
using VecD = hn::Vec<Doubles>;

/// Vectors in three registers.
struct Vec3 {
    VecD x, y, z;
};

HWY_INLINE Vec3 load3(const std::array<HullLanes::Lanes<double>, 3>& from, size_t lane) {
    const Doubles d;
    return {hn::Load(d, &from[0][lane]), hn::Load(d, &from[1][lane]), hn::Load(d, &from[2][lane])};
}

HWY_INLINE Vec3 subtract(const Vec3& a, const Vec3& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

HWY_INLINE Vec3 add(const Vec3& a, const Vec3& b) {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}

HWY_INLINE Vec3 scale(const Vec3& a, VecD factor) {
    return {hn::Mul(a.x, factor), hn::Mul(a.y, factor), hn::Mul(a.z, factor)};
}

HWY_INLINE Vec3 cross(const Vec3& a, const Vec3& b) {
    return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(b.y, a.z)),
            hn::Sub(hn::Mul(a.z, b.x), hn::Mul(b.z, a.x)),
            hn::Sub(hn::Mul(a.x, b.y), hn::Mul(b.x, a.y))};
}

HWY_INLINE VecD dot(const Vec3& a, const Vec3& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

/// The cubics of `hull_cell_weights` in the lanes.
struct Cubics {
    VecD c0, c1, c2, c3;
};

/// `MovingTriangle` in the lanes.
struct Triangles {
    Vec3 first, second, to_query;
    Vec3 first_rate, second_rate, third_ray;
};

HWY_INLINE Cubics plane_cubics(const Triangles& at) {
    const Vec3 n0 = cross(at.first, at.second);
    const Vec3 n1 = add(cross(at.first, at.second_rate), cross(at.first_rate, at.second));
    const Vec3 n2 = cross(at.first_rate, at.second_rate);
    const Vec3 &d = at.to_query, &v2 = at.third_ray;
    return {dot(n0, d), hn::Sub(dot(n1, d), dot(n0, v2)), hn::Sub(dot(n2, d), dot(n1, v2)),
            hn::Neg(dot(n2, v2))};
}

/// `root_of_falling` in each lane of `is_falling`; what the others hold has no meaning.
HWY_INLINE VecD roots_of_falling(const Cubics& c, hn::Mask<Doubles> is_falling) {
    const Doubles d;
    const VecD root =
        hn::Sqrt(hn::Sub(hn::Mul(c.c1, c.c1), hn::Mul(hn::Mul(hn::Set(d, 4.0), c.c2), c.c0)));
    VecD t = hn::Div(hn::Mul(hn::Set(d, 2.0), c.c0), hn::Sub(root, c.c1));
    auto is_active = is_falling;
    for (int step = 0; step < 100 && !hn::AllFalse(d, is_active); ++step) {
        const VecD value =
            hn::Add(hn::Mul(hn::Add(hn::Mul(hn::Add(hn::Mul(c.c3, t), c.c2), t), c.c1), t), c.c0);
        const VecD slope = hn::Add(hn::Mul(hn::Add(hn::Mul(hn::Mul(hn::Set(d, 3.0), c.c3), t),
                                                   hn::Mul(hn::Set(d, 2.0), c.c2)),
                                           t),
                                   c.c1);
        const VecD next = hn::Sub(t, hn::Div(value, slope));
        const auto goes_on = hn::Lt(next, hn::Mul(t, hn::Set(d, 1 - 1e-8)));
        t = hn::IfThenElse(is_active, next, t);
        is_active = hn::And(is_active, goes_on);
    }
    return t;
}

/// The lanes from `lane` on, scaled as `hull_cell_weights` does.
HWY_INLINE Triangles load_triangles(const HullLanes& lanes, size_t lane) {
    const Doubles d;
    const Vec3 first = load3(lanes.first, lane);
    const Vec3 second = load3(lanes.second, lane);
    const Vec3 to_query = load3(lanes.to_query, lane);
    const VecD square =
        hn::Max(hn::Max(dot(first, first), dot(second, second)), dot(to_query, to_query));
    const VecD unit = hn::Div(hn::Set(d, 1.0), hn::Sqrt(square));
    const Vec3 third = load3(lanes.rays[2], lane);
    return {scale(first, unit),
            scale(second, unit),
            scale(to_query, unit),
            subtract(load3(lanes.rays[0], lane), third),
            subtract(load3(lanes.rays[1], lane), third),
            third};
}

/// `hull_cell_weights` of the lanes from `lane` on, where its cubic falls.
HWY_INLINE void hull_weights_from(HullLanes& lanes, size_t lane) {
    const Doubles d;
    const VecD zero = hn::Zero(d);
    const Triangles triangles = load_triangles(lanes, lane);
    const Cubics c = plane_cubics(triangles);
    const auto is_falling = hn::And(hn::And(hn::Gt(c.c0, zero), hn::Lt(c.c1, zero)),
                                    hn::And(hn::Le(c.c2, zero), hn::Le(c.c3, zero)));
    const VecD t = roots_of_falling(c, is_falling);
    const Vec3 first = add(triangles.first, scale(triangles.first_rate, t));
    const Vec3 second = add(triangles.second, scale(triangles.second_rate, t));
    const Vec3 to_query = subtract(triangles.to_query, scale(triangles.third_ray, t));
    const Vec3 normal = cross(first, second);
    const VecD area = dot(normal, normal);
    const VecD longest = hn::Max(dot(first, first), dot(second, second));
    const VecD per_area = hn::Div(hn::Set(d, 1.0), area);
    const VecD w0 = hn::Mul(dot(cross(to_query, second), normal), per_area);
    const VecD w1 = hn::Mul(dot(cross(first, to_query), normal), per_area);
    hn::Store(w0, d, &lanes.weights[0][lane]);
    hn::Store(w1, d, &lanes.weights[1][lane]);
    hn::Store(hn::Sub(hn::Sub(hn::Set(d, 1.0), w0), w1), d, &lanes.weights[2][lane]);
    const auto is_known =
        hn::And(hn::And(is_falling, hn::Le(t, hn::Set(d, kFarthestRoot))),
                hn::Gt(area, hn::Mul(hn::Mul(hn::Set(d, kFlatTriangle), longest), longest)));
    alignas(64) double known[HullLanes::kCount];
    hn::Store(hn::IfThenElse(is_known, hn::Set(d, 1.0), zero), d, known);
    for (size_t i = 0; i < hn::Lanes(d); ++i) lanes.is_known[lane + i] = known[i] != 0.0;
}

void hull_weights(HullLanes& lanes) {
    for (size_t lane = 0; lane < HullLanes::kCount; lane += hn::Lanes(Doubles())) {
        hull_weights_from(lanes, lane);
    }
}

}  // namespace tetralight::detail::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace tetralight::detail {

HWY_EXPORT(hull_weights);

void hull_weights_in_vectors(HullLanes& lanes) {
    HWY_DYNAMIC_DISPATCH(hull_weights)(lanes);
}

}  // namespace tetralight::detail

#endif
