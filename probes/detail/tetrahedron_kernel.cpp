// SPDX-License-Identifier: Apache-2.0
// Compiled once for each kind of processor: Highway includes this file again and again.
#include <tetralight/probes/detail/vector_kernels.h>

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE <tetralight/probes/detail/tetrahedron_kernel.cpp>
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <tetralight/probes/detail/tetrahedron_test.h>

HWY_BEFORE_NAMESPACE();

namespace tetralight::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_MAX_BYTES >= 32 && !HWY_HAVE_SCALABLE

using Doubles = hn::CappedTag<double, kMostLanes>;
using Floats = hn::Rebind<float, Doubles>;
using Integers = hn::Rebind<int32_t, Doubles>;
using Indices = hn::Rebind<uint32_t, Doubles>;
using VecD = hn::Vec<Doubles>;
using VecF = hn::Vec<Floats>;
using VecU = hn::Vec<Indices>;

constexpr size_t kLanes = hn::MaxLanes(Doubles());

using Four = hn::FixedTag<float, 4>;

/// Four numbers of one record in each register; lane 4b + j is in block b of row j.
struct Rows {
    VecF r0, r1, r2, r3;
};

/// Reads 16 bytes from `from(lane)` for each lane.
template <class From>
HWY_INLINE VecF load_row(From from, size_t j) {
    const Four four;
    if constexpr (kLanes == 4) {
        return hn::LoadU(four, from(j));
    } else {
        return hn::Combine(Floats(), hn::LoadU(four, from(4 + j)), hn::LoadU(four, from(j)));
    }
}

/// Rows to columns or back, in each block of four lanes.
HWY_INLINE Rows transpose(const Rows& rows) {
    const Floats d;
    const hn::Repartition<double, Floats> pairs;
    const auto ab_low = hn::BitCast(pairs, hn::InterleaveLower(d, rows.r0, rows.r1));
    const auto ab_high = hn::BitCast(pairs, hn::InterleaveUpper(d, rows.r0, rows.r1));
    const auto cd_low = hn::BitCast(pairs, hn::InterleaveLower(d, rows.r2, rows.r3));
    const auto cd_high = hn::BitCast(pairs, hn::InterleaveUpper(d, rows.r2, rows.r3));
    return {hn::BitCast(d, hn::InterleaveLower(pairs, ab_low, cd_low)),
            hn::BitCast(d, hn::InterleaveUpper(pairs, ab_low, cd_low)),
            hn::BitCast(d, hn::InterleaveLower(pairs, ab_high, cd_high)),
            hn::BitCast(d, hn::InterleaveUpper(pairs, ab_high, cd_high))};
}

template <class From>
HWY_INLINE Rows load_columns(From from) {
    return transpose({load_row(from, 0), load_row(from, 1), load_row(from, 2), load_row(from, 3)});
}

struct Vec3 {
    VecD x, y, z;
};

HWY_INLINE VecD dot(const Vec3& a, const Vec3& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

HWY_INLINE Vec3 cross(const Vec3& a, const Vec3& b) {
    return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(b.y, a.z)),
            hn::Sub(hn::Mul(a.z, b.x), hn::Mul(b.z, a.x)),
            hn::Sub(hn::Mul(a.x, b.y), hn::Mul(b.x, a.y))};
}

HWY_INLINE VecD farthest_of(const Vec3& v) {
    return hn::Max(hn::Max(hn::Abs(v.x), hn::Abs(v.y)), hn::Abs(v.z));
}

/// `hn::Compress`. That of Highway 1.0.3 for eight doubles copies a table of 2 KiB each time.
template <class MaskD>
HWY_INLINE VecD compress(VecD v, MaskD mask) {
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
    return VecD{_mm512_maskz_compress_pd(mask.raw, v.raw)};
#else
    return hn::Compress(v, mask);
#endif
}

/// What a test found, where it is not a face.
constexpr int32_t kInside = 4;
constexpr int32_t kDoubtful = 5;

/// The tests of one pass.
class Pass {
  public:
    HWY_INLINE Pass(const ProbeVolumeView& volume, QueryBlock& block)
        : volume_(volume),
          block_(block),
          list_(block.tetrahedra),
          cells_(volume.cells.data()),
          positions_(&volume.positions[0].x),
          probe_count_(static_cast<uint32_t>(volume.positions.size())),
          cell_count_(static_cast<uint32_t>(volume.cells.size())),
          inner_count_(volume.info.inner_cell_count) {}

    HWY_INLINE void run() {
        fill_last_vector();
        for (size_t i = 0; i < list_.count; i += kLanes) {
            test(i);
        }
        list_.count = kept_;
    }

  private:
    using List = QueryList<QueryBlock::kSize>;

    /// Lanes behind the end repeat the last query; what they find is written behind the end, too.
    HWY_INLINE void fill_last_vector() {
        const size_t end = (list_.count + kLanes - 1) / kLanes * kLanes;
        for (size_t i = list_.count; i < end; ++i) {
            list_.move(list_.count - 1, i);
            list_.query[i] = QueryBlock::kSize;
        }
    }

    HWY_INLINE void test(size_t i) {
        const Doubles d;
        const Indices du;
        const uint32_t* cells = &list_.cell[i];
        const auto vertices = load_columns([&](size_t lane) HWY_ATTR {
            return reinterpret_cast<const float*>(cells_[cells[lane]].vertices.data());
        });
        const VecU last =
            hn::Max(hn::Max(hn::BitCast(du, vertices.r0), hn::BitCast(du, vertices.r1)),
                    hn::Max(hn::BitCast(du, vertices.r2), hn::BitCast(du, vertices.r3)));
        // Corners are read as four floats, of the last probe one too many.
        const bool has_room = hn::AllTrue(du, hn::Lt(last, hn::Set(du, probe_count_ - 1)));
        if (HWY_UNLIKELY(!has_room)) return test_alone(i);
        const Vec3 query{hn::Load(d, &list_.x[i]), hn::Load(d, &list_.y[i]),
                         hn::Load(d, &list_.z[i])};
        judge(i, load_corners(cells, 0, query), load_corners(cells, 1, query),
              load_corners(cells, 2, query), load_corners(cells, 3, query));
    }

    HWY_INLINE Vec3 load_corners(const uint32_t* cells, size_t corner, const Vec3& query) const {
        const Doubles d;
        const Rows columns = load_columns([&](size_t lane) HWY_ATTR {
            return positions_ + 3 * size_t{cells_[cells[lane]].vertices[corner]};
        });
        return {hn::Sub(hn::PromoteTo(d, columns.r0), query.x),
                hn::Sub(hn::PromoteTo(d, columns.r1), query.y),
                hn::Sub(hn::PromoteTo(d, columns.r2), query.z)};
    }

    /// `test_tetrahedron` behind its corners.
    HWY_INLINE void judge(size_t i, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& e) {
        const Doubles d;
        const VecD farthest = hn::Max(hn::Max(farthest_of(a), farthest_of(b)),
                                      hn::Max(farthest_of(c), farthest_of(e)));
        const Vec3 ce = cross(c, e), ab = cross(a, b);
        const VecD w0 = dot(b, ce), w1 = hn::Neg(dot(a, ce));
        const VecD w2 = dot(e, ab), w3 = hn::Neg(dot(c, ab));
        const VecD sum = hn::Add(hn::Add(w0, w2), hn::Add(w1, w3));
        const VecD smallest = hn::Min(hn::Min(w0, w1), hn::Min(w2, w3));
        const VecD cube = hn::Mul(hn::Mul(farthest, farthest), farthest);
        const VecD rounding = hn::Mul(hn::Set(d, kVolumeRounding), cube);
        const auto is_inside = hn::And(hn::Gt(sum, hn::Mul(hn::Set(d, kThinVolume), cube)),
                                       hn::Ge(smallest, hn::Zero(d)));
        const auto is_outside = hn::And(hn::Gt(sum, rounding), hn::Lt(smallest, hn::Neg(rounding)));
        // The face to leave by, or what was found instead, as a number: masks of doubles and of
        // indices have different lanes.
        VecD way = hn::IfThenElse(hn::Eq(w2, smallest), hn::Set(d, 2.0), hn::Set(d, 3.0));
        way = hn::IfThenElse(hn::Eq(w1, smallest), hn::Set(d, 1.0), way);
        way = hn::IfThenElse(hn::Eq(w0, smallest), hn::Set(d, 0.0), way);
        way = hn::IfThenElse(is_outside, way, hn::Set(d, static_cast<double>(kDoubtful)));
        way = hn::IfThenElse(is_inside, hn::Set(d, static_cast<double>(kInside)), way);
        write_locations(i, w0, w1, w2, w3);
        move_on(i, hn::DemoteTo(Integers(), way));
    }

    HWY_INLINE void write_locations(size_t i, VecD v0, VecD v1, VecD v2, VecD v3) {
        const Doubles d;
        const Floats f;
        const VecD zero = hn::Zero(d);
        const auto positive = [&](VecD w)
                                  HWY_ATTR { return hn::IfThenElseZero(hn::Gt(w, zero), w); };
        const VecD w0 = positive(v0), w1 = positive(v1);
        const VecD w2 = positive(v2), w3 = positive(v3);
        const VecD unit = hn::Div(hn::Set(d, 1.0), hn::Add(hn::Add(w0, w2), hn::Add(w1, w3)));
        const auto share = [&](VecD w) HWY_ATTR { return hn::DemoteTo(f, hn::Mul(w, unit)); };
        const Rows rows = transpose({share(w0), share(w1), share(w2), share(w3)});
        alignas(64) std::array<std::array<float, kLanes>, 4> weights;
        hn::Store(rows.r0, f, weights[0].data());
        hn::Store(rows.r1, f, weights[1].data());
        hn::Store(rows.r2, f, weights[2].data());
        hn::Store(rows.r3, f, weights[3].data());
        const Four four;
        for (size_t lane = 0; lane < kLanes; ++lane) {
            CellLocation& location = block_.location[list_.query[i + lane]];
            location.cell = list_.cell[i + lane];
            location.ambient = 0.0f;
            hn::StoreU(hn::Load(four, &weights[lane % 4][lane / 4 * 4]), four, &location.weights.x);
        }
    }

    /// Sorts the queries of a vector into the lists that they go on in.
    HWY_INLINE void move_on(size_t i, hn::Vec<Integers> way) {
        const Indices du;
        const VecU next = neighbor_across(i, way);
        const auto is_way = [&](int32_t value) HWY_ATTR {
            return hn::RebindMask(du, hn::Eq(way, hn::Set(Integers(), value)));
        };
        const auto is_real = hn::FirstN(du, list_.count - i);
        const auto goes_on = hn::AndNot(hn::Or(is_way(kInside), is_way(kDoubtful)), is_real);
        const auto is_inner = hn::And(goes_on, hn::Lt(next, hn::Set(du, inner_count_)));
        const auto is_hull =
            hn::And(hn::AndNot(is_inner, goes_on), hn::Lt(next, hn::Set(du, cell_count_)));
        const auto is_settled = hn::Or(is_way(kInside), hn::Or(is_inner, is_hull));
        const auto is_doubtful = hn::AndNot(is_settled, is_real);
        auto& hull = block_.hull_cells;
        if (!hn::AllFalse(du, is_hull)) hull.count += append(hull, hull.count, i, next, is_hull);
        if (HWY_UNLIKELY(!hn::AllFalse(du, is_doubtful))) {
            auto& count = block_.doubtful_count;
            const VecU query = hn::Load(du, &list_.query[i]);
            const VecU cell = hn::Load(du, &list_.cell[i]);
            hn::StoreU(hn::Compress(query, is_doubtful), du, &block_.doubtful[count]);
            hn::StoreU(hn::Compress(cell, is_doubtful), du, &block_.doubtful_cell[count]);
            count += hn::CountTrue(du, is_doubtful);
        }
        const size_t kept = kept_;
        kept_ += append(list_, kept_, i, next, is_inner);
        for (size_t k = kept; k < kept_; ++k) hwy::Prefetch(&cells_[list_.cell[k]]);
    }

    HWY_INLINE VecU neighbor_across(size_t i, hn::Vec<Integers> face) const {
        const Indices du;
        const Integers di;
        const Rows neighbors = load_columns([&](size_t lane) HWY_ATTR {
            return reinterpret_cast<const float*>(cells_[list_.cell[i + lane]].neighbors.data());
        });
        VecU next = hn::BitCast(du, neighbors.r3);
        const auto choose = [&](int32_t value, VecF row) HWY_ATTR {
            const auto is_it = hn::RebindMask(du, hn::Eq(face, hn::Set(di, value)));
            next = hn::IfThenElse(is_it, hn::BitCast(du, row), next);
        };
        choose(2, neighbors.r2);
        choose(1, neighbors.r1);
        choose(0, neighbors.r0);
        return next;
    }

    /// Adds the queries of a mask, whose next cells are `next`, to a list at place `at`.
    template <class MaskU>
    HWY_INLINE size_t append(List& list, size_t at, size_t i, VecU next, MaskU mask) {
        const Doubles d;
        const Indices du;
        alignas(8) uint8_t bits[8] = {};
        hn::StoreMaskBits(du, mask, bits);
        const auto wide = hn::LoadMaskBits(d, bits);
        const VecD x = hn::Load(d, &list_.x[i]);
        const VecD y = hn::Load(d, &list_.y[i]);
        const VecD z = hn::Load(d, &list_.z[i]);
        const VecU query = hn::Load(du, &list_.query[i]);
        hn::StoreU(compress(x, wide), d, &list.x[at]);
        hn::StoreU(compress(y, wide), d, &list.y[at]);
        hn::StoreU(compress(z, wide), d, &list.z[at]);
        hn::StoreU(hn::Compress(query, mask), du, &list.query[at]);
        hn::StoreU(hn::Compress(next, mask), du, &list.cell[at]);
        return hn::CountTrue(du, mask);
    }

    /// The vector at `i` by plain code: an index is out of range, or that of the last probe.
    HWY_NOINLINE void test_alone(size_t i) {
        const size_t end = std::min(i + kLanes, list_.count);
        for (; i < end; ++i) kept_ = test_query(volume_, block_, i, kept_);
    }

    const ProbeVolumeView& volume_;
    QueryBlock& block_;
    List& list_;
    const Cell* cells_;
    const float* positions_;
    uint32_t probe_count_;
    uint32_t cell_count_;
    uint32_t inner_count_;
    size_t kept_ = 0;
};

void test_tetrahedra(const ProbeVolumeView& volume, QueryBlock& block) {
    if (block.tetrahedra.count > 0) Pass(volume, block).run();
}

#else

void test_tetrahedra(const ProbeVolumeView& volume, QueryBlock& block) {
    scalar_kernels().test_tetrahedra(volume, block);
}

#endif

}  // namespace tetralight::detail::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace tetralight::detail {

HWY_EXPORT(test_tetrahedra);

void test_tetrahedra_in_vectors(const ProbeVolumeView& volume, QueryBlock& block) {
    HWY_DYNAMIC_DISPATCH(test_tetrahedra)(volume, block);
}

}  // namespace tetralight::detail

#endif
