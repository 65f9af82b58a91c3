// SPDX-License-Identifier: Apache-2.0
// Compiled once for each kind of processor: Highway includes this file again and again.
#include <tetralight/probes/detail/vector_kernels.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE <tetralight/probes/detail/hull_kernel.cpp>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <tetralight/probes/detail/hull_cell.h>
#include <tetralight/probes/detail/vectors-inl.h>

HWY_BEFORE_NAMESPACE();

namespace tetralight::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#ifdef TETRALIGHT_HAS_WIDE_VECTORS

using Doubles = hn::CappedTag<double, CellLanes::kCount>;
using Floats = hn::Rebind<float, Doubles>;
using VecD = hn::Vec<Doubles>;
using Vector = Vec3<VecD>;

/// The cubics of `hull_cell_weights` in the lanes.
struct Cubics {
    VecD c0, c1, c2, c3;
};

/// `MovingTriangle` in the lanes.
struct Triangles {
    Vector first, second, to_query;
    Vector first_rate, second_rate, third_ray;
};

HWY_INLINE Cubics plane_cubics(const Triangles& at) {
    const Vector n0 = cross(at.first, at.second);
    const Vector n1 = add(cross(at.first, at.second_rate), cross(at.first_rate, at.second));
    const Vector n2 = cross(at.first_rate, at.second_rate);
    const Vector &d = at.to_query, &v2 = at.third_ray;
    return {dot(n0, d), hn::Sub(dot(n1, d), dot(n0, v2)), hn::Sub(dot(n2, d), dot(n1, v2)),
            hn::Neg(dot(n2, v2))};
}

/// `hull_cell_weights` of a vector of queries, in lanes where its cubic falls.
class Weigher {
  public:
    HWY_INLINE explicit Weigher(const Triangles& triangles)
        : triangles_(triangles), cubics_(plane_cubics(triangles)) {
        const Doubles d;
        const VecD zero = hn::Zero(d);
        const Cubics& c = cubics_;
        is_falling_ = hn::And(hn::And(hn::Gt(c.c0, zero), hn::Lt(c.c1, zero)),
                              hn::And(hn::Le(c.c2, zero), hn::Le(c.c3, zero)));
        is_moving_ = is_falling_;
        const VecD root =
            hn::Sqrt(hn::Sub(hn::Mul(c.c1, c.c1), hn::Mul(hn::Mul(hn::Set(d, 4.0), c.c2), c.c0)));
        t_ = hn::Div(hn::Mul(hn::Set(d, 2.0), c.c0), hn::Sub(root, c.c1));
    }

    HWY_INLINE bool has_roots() const { return hn::AllFalse(Doubles(), is_moving_); }

    /// One of Newton's steps of `root_of_falling`.
    HWY_INLINE void step() {
        const Doubles d;
        const Cubics& c = cubics_;
        const VecD t = t_;
        const VecD value =
            hn::Add(hn::Mul(hn::Add(hn::Mul(hn::Add(hn::Mul(c.c3, t), c.c2), t), c.c1), t), c.c0);
        const VecD slope = hn::Add(hn::Mul(hn::Add(hn::Mul(hn::Mul(hn::Set(d, 3.0), c.c3), t),
                                                   hn::Mul(hn::Set(d, 2.0), c.c2)),
                                           t),
                                   c.c1);
        const VecD next = hn::Sub(t, hn::Div(value, slope));
        t_ = hn::IfThenElse(is_moving_, next, t);
        is_moving_ = hn::And(is_moving_, hn::Lt(next, hn::Mul(t, hn::Set(d, 1 - 1e-8))));
    }

    HWY_INLINE void write(size_t lane, CellLanes& lanes) const {
        const Doubles d;
        const Vector first = add(triangles_.first, scale(triangles_.first_rate, t_));
        const Vector second = add(triangles_.second, scale(triangles_.second_rate, t_));
        const Vector to_query = subtract(triangles_.to_query, scale(triangles_.third_ray, t_));
        const Vector normal = cross(first, second);
        const VecD area = dot(normal, normal);
        const VecD longest = hn::Max(dot(first, first), dot(second, second));
        const VecD per_area = hn::Div(hn::Set(d, 1.0), area);
        const VecD w0 = hn::Mul(dot(cross(to_query, second), normal), per_area);
        const VecD w1 = hn::Mul(dot(cross(first, to_query), normal), per_area);
        hn::Store(w0, d, &lanes.values[0][lane]);
        hn::Store(w1, d, &lanes.values[1][lane]);
        hn::Store(hn::Sub(hn::Sub(hn::Set(d, 1.0), w0), w1), d, &lanes.values[2][lane]);
        const auto is_known =
            hn::And(hn::And(is_falling_, hn::Le(t_, hn::Set(d, kFarthestRoot))),
                    hn::Gt(area, hn::Mul(hn::Mul(hn::Set(d, kFlatTriangle), longest), longest)));
        alignas(64) std::array<double, hn::MaxLanes(Doubles())> known;
        hn::Store(hn::IfThenElseZero(is_known, hn::Set(d, 1.0)), d, known.data());
        for (size_t i = 0; i < known.size(); ++i) lanes.is_known[lane + i] = known[i] != 0.0;
    }

  private:
    Triangles triangles_;
    Cubics cubics_;
    hn::Mask<Doubles> is_falling_, is_moving_;
    VecD t_;
};

class HullReader {
  public:
    HWY_INLINE HullReader(const ProbeVolumeView& volume, const QueryBlock& block)
        : volume_(volume), block_(block), reader_(volume) {}

    /// True if `load` may read these cells.
    HWY_INLINE bool is_readable(const uint32_t* cells) {
        const hn::Rebind<uint32_t, Doubles> du;
        const auto index =
            hn::Sub(hn::LoadU(du, cells), hn::Set(du, volume_.info.inner_cell_count));
        const auto count = hn::Set(du, static_cast<uint32_t>(volume_.hull_rays.size()));
        return hn::AllTrue(du, hn::Lt(index, count)) && reader_.find_corners<3>(cells);
    }

    /// Corners and rays relative to the queries, scaled as `hull_cell_weights` does.
    HWY_INLINE Triangles load(const uint32_t* cells, const uint32_t* queries) const {
        const Doubles d;
        const Vector last = promote(d, reader_.load(2));
        const Vector first = subtract(promote(d, reader_.load(0)), last);
        const Vector second = subtract(promote(d, reader_.load(1)), last);
        const Vector to_query = subtract(load_queries(d, block_, queries), last);
        const VecD square =
            hn::Max(hn::Max(dot(first, first), dot(second, second)), dot(to_query, to_query));
        const VecD unit = hn::Div(hn::Set(d, 1.0), hn::Sqrt(square));
        const auto rays = load_rays(cells);
        return {scale(first, unit),         scale(second, unit),        scale(to_query, unit),
                subtract(rays[0], rays[2]), subtract(rays[1], rays[2]), rays[2]};
    }

  private:
    HWY_INLINE std::array<Vector, 3> load_rays(const uint32_t* cells) const {
        const Doubles d;
        const auto columns = [&](size_t begin) HWY_ATTR {
            return load_columns(Floats(), [&](size_t lane) HWY_ATTR {
                const uint32_t index = cells[lane] - volume_.info.inner_cell_count;
                return &volume_.hull_rays[index].rays[0].x + begin;
            });
        };
        // Nine floats: the last four overlap the four before.
        const Rows<Floats> first = columns(0), second = columns(4), third = columns(5);
        return {promote(d, first), promote(d, first.r3, second.r0, second.r1),
                promote(d, third.r1, third.r2, third.r3)};
    }

    const ProbeVolumeView& volume_;
    const QueryBlock& block_;
    CornerReader<Floats> reader_;
};

void measure_hull_cells(const ProbeVolumeView& volume, const QueryBlock& block,
                        const CellList& list, size_t begin, CellLanes& lanes) {
    constexpr size_t kLanes = hn::MaxLanes(Doubles());
    lanes.is_known.fill(false);
    HullReader reader(volume, block);
    const auto weigher = [&](size_t lane) HWY_ATTR {
        return Weigher(reader.load(&list.cell[begin + lane], &list.query[begin + lane]));
    };
    // Two vectors at a time: while one waits for a division the other computes.
    for (size_t lane = 0; lane < CellLanes::kCount; lane += 2 * kLanes) {
        if (begin + lane >= list.count || !reader.is_readable(&list.cell[begin + lane])) return;
        Weigher first = weigher(lane);
        const size_t next = lane + kLanes;
        if (begin + next >= list.count || !reader.is_readable(&list.cell[begin + next])) {
            for (int step = 0; step < 100 && !first.has_roots(); ++step) first.step();
            return first.write(lane, lanes);
        }
        Weigher second = weigher(next);
        for (int step = 0; step < 100 && !(first.has_roots() && second.has_roots()); ++step) {
            first.step();
            second.step();
        }
        first.write(lane, lanes);
        second.write(next, lanes);
    }
}

#else

void measure_hull_cells(const ProbeVolumeView& volume, const QueryBlock& block,
                        const CellList& list, size_t begin, CellLanes& lanes) {
    scalar_kernels().measure_hull_cells(volume, block, list, begin, lanes);
}

#endif

}  // namespace tetralight::detail::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace tetralight::detail {

HWY_EXPORT(measure_hull_cells);

void measure_hull_cells_in_vectors(const ProbeVolumeView& volume, const QueryBlock& block,
                                   const CellList& list, size_t begin, CellLanes& lanes) {
    HWY_DYNAMIC_DISPATCH(measure_hull_cells)(volume, block, list, begin, lanes);
}

}  // namespace tetralight::detail

#endif
