// SPDX-License-Identifier: Apache-2.0
// Compiled once for each kind of processor: Highway includes this file again and again.
#include <tetralight/probes/detail/vector_kernels.h>

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE <tetralight/probes/detail/place_kernel.cpp>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <tetralight/probes/detail/cell_corners.h>
#include <tetralight/probes/detail/query_pass.h>
#include <tetralight/probes/detail/vectors-inl.h>

HWY_BEFORE_NAMESPACE();

namespace tetralight::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#ifdef TETRALIGHT_HAS_WIDE_VECTORS

using Doubles = hn::CappedTag<double, 8>;
using Floats = hn::Rebind<float, Doubles>;
using Indices = hn::Rebind<uint32_t, Doubles>;
using Integers = hn::Rebind<int32_t, Doubles>;
using VecD = hn::Vec<Doubles>;
using VecF = hn::Vec<Floats>;
using VecU = hn::Vec<Indices>;

class Placer {
  public:
    HWY_INLINE Placer(const SeedGridHeader& grid, const VolumeInfo& info, QueryBlock& block)
        : info_(info), grid_(grid), block_(block) {
        const double farthest = farthest_reach(info_);
        farthest_square_ =
            farthest > 0.0 ? farthest * farthest : std::numeric_limits<double>::infinity();
    }

    /// The queries of a vector from `i` on.
    HWY_INLINE void place(size_t i) {
        const Doubles d;
        const Floats f;
        Vec3<VecF> world;
        hn::LoadInterleaved3(f, &block_.position[i].x, world.x, world.y, world.z);
        const Vec3<VecD> local{
            hn::Sub(hn::PromoteTo(d, world.x), hn::Set(d, info_.world_origin.x)),
            hn::Sub(hn::PromoteTo(d, world.y), hn::Set(d, info_.world_origin.y)),
            hn::Sub(hn::PromoteTo(d, world.z), hn::Set(d, info_.world_origin.z))};
        const Vec3<VecF> narrow{hn::DemoteTo(f, local.x), hn::DemoteTo(f, local.y),
                                hn::DemoteTo(f, local.z)};
        hn::Store(narrow.x, f, &block_.tetrahedra.x[i]);
        hn::Store(narrow.y, f, &block_.tetrahedra.y[i]);
        hn::Store(narrow.z, f, &block_.tetrahedra.z[i]);
        const VecF none = hn::Add(hn::Add(hn::Sub(world.x, world.x), hn::Sub(world.y, world.y)),
                                  hn::Sub(world.z, world.z));
        const auto is_finite = hn::Eq(hn::PromoteTo(d, none), hn::Zero(d));
        const VecD course =
            hn::IfThenElseZero(is_finite, find_course(local, narrow));  // else `NotFinite`
        const Integers di;
        const Indices du;
        const auto courses = hn::DemoteTo(di, course);
        hn::Store(courses, di, reinterpret_cast<int32_t*>(&block_.course[i]));
        const auto is_near = hn::Gt(courses, hn::Set(di, static_cast<int32_t>(Course::Alone)));
        const VecU words =
            hn::IfThenElse(hn::RebindMask(du, is_near), find_words(narrow), hn::Set(du, kNoIndex));
        hn::Store(words, du, &block_.start[i]);
    }

  private:
    /// As a number, for finite positions.
    HWY_INLINE VecD find_course(const Vec3<VecD>& local, const Vec3<VecF>& narrow) const {
        const Doubles d;
        const auto number = [&](Course course)
                                HWY_ATTR { return hn::Set(d, static_cast<double>(course)); };
        const auto is_float = hn::And(hn::Eq(hn::PromoteTo(d, narrow.x), local.x),
                                      hn::And(hn::Eq(hn::PromoteTo(d, narrow.y), local.y),
                                              hn::Eq(hn::PromoteTo(d, narrow.z), local.z)));
        const VecD square = dot(local, local);
        const VecD course =
            hn::IfThenElse(is_float, number(Course::InFloat), number(Course::InDouble));
        return hn::IfThenElse(hn::Gt(square, hn::Set(d, farthest_square_)), number(Course::Alone),
                              course);
    }

    /// `seed_voxel`.
    HWY_INLINE VecU find_voxels(VecF coordinate, size_t axis) const {
        const Floats f;
        const Integers di;
        const uint32_t size = grid_.size[axis];
        const uint32_t side = size < kSeedGridLongestSide ? size : kSeedGridLongestSide;
        const uint32_t last = side > 0 ? side - 1 : 0;
        const VecF along = hn::Mul(hn::Sub(coordinate, hn::Set(f, grid_.min[axis])),
                                   hn::Set(f, grid_.scale[axis]));
        const VecF limit = hn::Set(f, static_cast<float>(last));
        const VecF below = hn::IfThenElse(hn::Lt(along, limit), along, limit);
        const VecF voxel = hn::IfThenElseZero(hn::Gt(along, hn::Zero(f)), below);
        return hn::BitCast(Indices(), hn::ConvertTo(di, voxel));
    }

    /// `seed_word` in the outermost grid.
    HWY_INLINE VecU find_words(const Vec3<VecF>& local) const {
        const Indices du;
        const VecU rows = hn::Add(hn::Mul(find_voxels(local.z, 2), hn::Set(du, grid_.size[1])),
                                  find_voxels(local.y, 1));
        const VecU voxels =
            hn::Add(hn::Mul(rows, hn::Set(du, grid_.size[0])), find_voxels(local.x, 0));
        return hn::Add(voxels, hn::Set(du, static_cast<uint32_t>(kSeedGridHeaderWords)));
    }

    const VolumeInfo& info_;
    const SeedGridHeader& grid_;
    QueryBlock& block_;
    double farthest_square_;
};

void place_queries(const SeedGridHeader& grid, const VolumeInfo& info, QueryBlock& block) {
    Placer placer(grid, info, block);
    for (size_t i = 0; i < block.count; i += hn::Lanes(Doubles())) placer.place(i);
}

/// Adds the queries of a mask to a list.
template <class MaskU>
HWY_INLINE void append(CellList& list, VecU query, VecU cell, MaskU mask) {
    const Indices du;
    hn::StoreU(hn::Compress(query, mask), du, &list.query[list.count]);
    hn::StoreU(hn::Compress(cell, mask), du, &list.cell[list.count]);
    list.count += hn::CountTrue(du, mask);
}

void begin_walks(const VolumeInfo& info, QueryBlock& block) {
    const Floats f;
    const Indices du;
    const Integers di;
    PositionList& list = block.tetrahedra;
    for (size_t i = 0; i < block.count; i += hn::Lanes(f)) {
        const auto course = hn::Load(di, reinterpret_cast<const int32_t*>(&block.course[i]));
        const bool is_full = i + hn::Lanes(f) <= block.count;
        if (!is_full || !hn::AllTrue(di, hn::Eq(course, hn::Set(di, int32_t(Course::InFloat))))) {
            const size_t end = std::min(i + hn::Lanes(f), block.count);
            for (size_t k = i; k < end; ++k) begin_walk(info, block, static_cast<uint32_t>(k));
            continue;
        }
        const VecU start = hn::Load(du, &block.start[i]);
        const VecU query = hn::Iota(du, static_cast<uint32_t>(i));
        const VecF x = hn::Load(f, &list.x[i]), y = hn::Load(f, &list.y[i]);
        const VecF z = hn::Load(f, &list.z[i]);
        const auto is_inner = hn::Lt(start, hn::Set(du, info.inner_cell_count));
        const auto mask = hn::RebindMask(f, is_inner);
        hn::StoreU(hn::Compress(x, mask), f, &list.x[list.count]);
        hn::StoreU(hn::Compress(y, mask), f, &list.y[list.count]);
        hn::StoreU(hn::Compress(z, mask), f, &list.z[list.count]);
        append(list, query, start, is_inner);
        append(block.hull_cells, query, start, hn::Not(is_inner));
    }
}

#else

void place_queries(const SeedGridHeader& grid, const VolumeInfo& info, QueryBlock& block) {
    scalar_kernels().place_queries(grid, info, block);
}

void begin_walks(const VolumeInfo& info, QueryBlock& block) {
    scalar_kernels().begin_walks(info, block);
}

#endif

}  // namespace tetralight::detail::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace tetralight::detail {

HWY_EXPORT(place_queries);
HWY_EXPORT(begin_walks);

void place_queries_in_vectors(const SeedGridHeader& grid, const VolumeInfo& info,
                              QueryBlock& block) {
    HWY_DYNAMIC_DISPATCH(place_queries)(grid, info, block);
}

void begin_walks_in_vectors(const VolumeInfo& info, QueryBlock& block) {
    HWY_DYNAMIC_DISPATCH(begin_walks)(info, block);
}

}  // namespace tetralight::detail

#endif
