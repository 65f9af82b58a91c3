// SPDX-License-Identifier: Apache-2.0
// Compiled once for each kind of processor: Highway includes this file again and again.
#include <tetralight/probes/detail/vector_kernels.h>

#include <algorithm>
#include <cstddef>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE <tetralight/probes/detail/tetrahedron_kernel.cpp>
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <tetralight/probes/detail/query_pass.h>
#include <tetralight/probes/detail/tetrahedron_test.h>
#include <tetralight/probes/detail/vectors-inl.h>

HWY_BEFORE_NAMESPACE();

namespace tetralight::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#ifdef TETRALIGHT_HAS_WIDE_VECTORS

using Floats = hn::CappedTag<float, kMostLanes>;
using Integers = hn::Rebind<int32_t, Floats>;
using Indices = hn::Rebind<uint32_t, Floats>;
using VecF = hn::Vec<Floats>;
using VecI = hn::Vec<Integers>;

constexpr size_t kLanes = hn::MaxLanes(Floats());

static_assert(offsetof(CellLocation, cell) == 0 && offsetof(CellLocation, ambient) == 4);

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
          reader_(volume),
          inner_count_(volume.info.inner_cell_count) {}

    HWY_INLINE void run() {
        fill_last_vector();
        for (size_t i = 0; i < list_.count; i += kLanes) test(i);
        leave();
    }

  private:
    /// Lanes behind the end repeat the last query; what they find is written behind the end, too.
    HWY_INLINE void fill_last_vector() {
        const size_t end = (list_.count + kLanes - 1) / kLanes * kLanes;
        for (size_t i = list_.count; i < end; ++i) {
            list_.move(list_.count - 1, i);
            list_.query[i] = kBlockSize;
        }
    }

    HWY_INLINE void test(size_t i) {
        const Floats f;
        const uint32_t* cells = &list_.cell[i];
        if (HWY_UNLIKELY(!reader_.find_corners<4>(cells))) return test_alone(i);
        const Vec3<VecF> query{hn::Load(f, &list_.x[i]), hn::Load(f, &list_.y[i]),
                               hn::Load(f, &list_.z[i])};
        const auto corner = [&](size_t k) HWY_ATTR {
            const Rows<Floats> columns = reader_.load(k);
            return subtract(Vec3<VecF>{columns.r0, columns.r1, columns.r2}, query);
        };
        judge(i, signed_volumes(corner(0), corner(1), corner(2), corner(3)));
    }

    /// `judge_volumes` in single precision.
    HWY_INLINE void judge(size_t i, const SignedVolumes<VecF>& v) {
        using Limits = VolumeLimits<float>;
        const Floats f;
        const VecF sum = hn::Add(hn::Add(v.w0, v.w2), hn::Add(v.w1, v.w3));
        const VecF smallest = hn::Min(hn::Min(v.w0, v.w1), hn::Min(v.w2, v.w3));
        const VecF cube = hn::Mul(hn::Mul(v.farthest, v.farthest), v.farthest);
        const auto is_able = hn::Gt(cube, hn::Set(f, Limits::kLeastCube));
        const auto is_inside =
            hn::And(is_able, hn::And(hn::Gt(sum, hn::Mul(hn::Set(f, Limits::kThin), cube)),
                                     hn::Ge(smallest, hn::Mul(hn::Set(f, Limits::kInside), cube))));
        const auto is_outside = hn::And(
            is_able,
            hn::And(hn::Gt(sum, hn::Mul(hn::Set(f, Limits::kSumRounding), cube)),
                    hn::Lt(smallest, hn::Neg(hn::Mul(hn::Set(f, Limits::kRounding), cube)))));
        const Integers di;
        const auto number = [&](int32_t value) HWY_ATTR { return hn::Set(di, value); };
        const auto choose = [&](auto mask, int32_t value, VecI otherwise) HWY_ATTR {
            return hn::IfThenElse(hn::RebindMask(di, mask), number(value), otherwise);
        };
        VecI way = choose(hn::Eq(v.w2, smallest), 2, number(3));
        way = choose(hn::Eq(v.w1, smallest), 1, way);
        way = choose(hn::Eq(v.w0, smallest), 0, way);
        way = hn::IfThenElse(hn::RebindMask(di, is_outside), way, number(kDoubtful));
        way = choose(is_inside, kInside, way);
        write_locations(i, v);
        sort(i, way);
    }

    HWY_INLINE void write_locations(size_t i, const SignedVolumes<VecF>& v) {
        const Floats f;
        const VecF zero = hn::Zero(f);
        const auto positive = [&](VecF w)
                                  HWY_ATTR { return hn::IfThenElseZero(hn::Gt(w, zero), w); };
        const VecF w0 = positive(v.w0), w1 = positive(v.w1);
        const VecF w2 = positive(v.w2), w3 = positive(v.w3);
        const VecF unit = hn::Div(hn::Set(f, 1.0f), hn::Add(hn::Add(w0, w2), hn::Add(w1, w3)));
        const Rows<Floats> rows = transpose(
            f, {hn::Mul(w0, unit), hn::Mul(w1, unit), hn::Mul(w2, unit), hn::Mul(w3, unit)});
        alignas(64) std::array<std::array<float, kLanes>, 4> weights;
        hn::Store(rows.r0, f, weights[0].data());
        hn::Store(rows.r1, f, weights[1].data());
        hn::Store(rows.r2, f, weights[2].data());
        hn::Store(rows.r3, f, weights[3].data());
        read_from_memory(weights.data());
        const hn::FixedTag<float, 4> four;
        for (size_t lane = 0; lane < kLanes; ++lane) {
            CellLocation& location = block_.location[list_.query[i + lane]];
            // Both at once: `ambient` 0 follows `cell`.
            const uint64_t cell_and_ambient = list_.cell[i + lane];
            std::memcpy(&location.cell, &cell_and_ambient, sizeof cell_and_ambient);
            hn::StoreU(hn::Load(four, &weights[lane % 4][lane / 4 * 4]), four, &location.weights.x);
        }
    }

    /// Sorts the queries of a vector into the lists where they continue.
    HWY_INLINE void sort(size_t i, VecI way) {
        const Floats f;
        const Integers di;
        const Indices du;
        const auto is_real = hn::FirstN(di, list_.count - i);
        const auto is_outside = hn::And(hn::Lt(way, hn::Set(di, kInside)), is_real);
        const auto is_doubtful = hn::And(hn::Eq(way, hn::Set(di, kDoubtful)), is_real);
        const auto query = hn::Load(du, &list_.query[i]);
        const auto cell = hn::Load(du, &list_.cell[i]);
        if (HWY_UNLIKELY(!hn::AllFalse(di, is_doubtful))) {
            CellList& precise = block_.precise;
            const auto mask = hn::RebindMask(du, is_doubtful);
            hn::StoreU(hn::Compress(query, mask), du, &precise.query[precise.count]);
            hn::StoreU(hn::Compress(cell, mask), du, &precise.cell[precise.count]);
            precise.count += hn::CountTrue(di, is_doubtful);
        }
        keep(i, query, cell, hn::BitCast(du, way), hn::RebindMask(du, is_outside));
    }

    /// Moves the queries of a mask, with the faces where they leave their cells, to the beginning.
    template <class VecU, class MaskU>
    HWY_INLINE void keep(size_t i, VecU query, VecU cell, VecU face, MaskU mask) {
        const Floats f;
        const Indices du;
        const auto float_mask = hn::RebindMask(f, mask);
        const VecF x = hn::Load(f, &list_.x[i]);
        const VecF y = hn::Load(f, &list_.y[i]);
        const VecF z = hn::Load(f, &list_.z[i]);
        hn::StoreU(hn::Compress(x, float_mask), f, &list_.x[kept_]);
        hn::StoreU(hn::Compress(y, float_mask), f, &list_.y[kept_]);
        hn::StoreU(hn::Compress(z, float_mask), f, &list_.z[kept_]);
        hn::StoreU(hn::Compress(query, mask), du, &list_.query[kept_]);
        hn::StoreU(hn::Compress(cell, mask), du, &list_.cell[kept_]);
        hn::StoreU(hn::Compress(face, mask), du, &list_.face[kept_]);
        kept_ += hn::CountTrue(du, mask);
    }

    /// Finds the next cells of all queries that leave one. A loop of its own, because its number of
    /// turns is foreseen better than that of each vector.
    HWY_INLINE void leave() {
        const size_t count = kept_;
        kept_ = 0;
        for (size_t from = 0; from < count; ++from) {
            const uint32_t cell = list_.cell[from], face = list_.face[from];
            const uint32_t next = face < 4 ? volume_.cells[cell].neighbors[face] : cell;
            if (HWY_LIKELY(next < inner_count_)) {
                hwy::Prefetch(&volume_.cells[next]);
                if (HWY_UNLIKELY(from != kept_)) list_.move(from, kept_);
                list_.cell[kept_++] = next;
            } else if (next < volume_.cells.size()) {
                block_.hull_cells.add(list_.query[from], next);
            } else {
                block_.precise.add(list_.query[from], cell);
            }
        }
        list_.count = kept_;
    }

    /// The vector at `i` by plain code, which finds next cells, too.
    HWY_NOINLINE void test_alone(size_t i) {
        const size_t end = std::min(i + kLanes, list_.count);
        for (; i < end; ++i) {
            const size_t kept = kept_;
            kept_ = test_query(volume_, block_, i, kept);
            if (kept_ > kept) list_.face[kept] = kInside;
        }
    }

    const ProbeVolumeView& volume_;
    QueryBlock& block_;
    PositionList& list_;
    CornerReader<Floats> reader_;
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
