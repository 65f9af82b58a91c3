// SPDX-License-Identifier: Apache-2.0
// What the vector kernels share, for one kind of processor: included after <hwy/highway.h>, once in
// each of Highway's passes over a kernel's file.

#if defined(TETRALIGHT_PROBES_DETAIL_VECTORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRALIGHT_PROBES_DETAIL_VECTORS_INL_H_
#undef TETRALIGHT_PROBES_DETAIL_VECTORS_INL_H_
#else
#define TETRALIGHT_PROBES_DETAIL_VECTORS_INL_H_
#endif

#include <hwy/highway.h>

#include <tetralight/base/compiler.h>
#include <tetralight/probes/detail/query_kernels.h>

HWY_BEFORE_NAMESPACE();

namespace tetralight::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#undef TETRALIGHT_HAS_WIDE_VECTORS
#if HWY_MAX_BYTES >= 32 && !HWY_HAVE_SCALABLE
/// Vectors have 4, 8 or 16 lanes, which the functions below combine from vectors of 4.
#define TETRALIGHT_HAS_WIDE_VECTORS 1
#endif

template <class V>
struct Vec3 {
    V x, y, z;
};

template <class V>
HWY_INLINE V dot(const Vec3<V>& a, const Vec3<V>& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

template <class V>
HWY_INLINE Vec3<V> cross(const Vec3<V>& a, const Vec3<V>& b) {
    return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(b.y, a.z)),
            hn::Sub(hn::Mul(a.z, b.x), hn::Mul(b.z, a.x)),
            hn::Sub(hn::Mul(a.x, b.y), hn::Mul(b.x, a.y))};
}

template <class V>
HWY_INLINE Vec3<V> add(const Vec3<V>& a, const Vec3<V>& b) {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}

template <class V>
HWY_INLINE Vec3<V> subtract(const Vec3<V>& a, const Vec3<V>& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

template <class V>
HWY_INLINE Vec3<V> scale(const Vec3<V>& a, V factor) {
    return {hn::Mul(a.x, factor), hn::Mul(a.y, factor), hn::Mul(a.z, factor)};
}

template <class V>
HWY_INLINE V farthest_of(const Vec3<V>& v) {
    return hn::Max(hn::Max(hn::Abs(v.x), hn::Abs(v.y)), hn::Abs(v.z));
}

/// Four signed volumes, as the function of that name for one query.
template <class V>
struct SignedVolumes {
    V w0, w1, w2, w3;
    V farthest;
};

template <class V>
HWY_INLINE SignedVolumes<V> signed_volumes(const Vec3<V>& a, const Vec3<V>& b, const Vec3<V>& c,
                                           const Vec3<V>& e) {
    const Vec3<V> ce = cross(c, e), ab = cross(a, b);
    return {
        dot(b, ce), hn::Neg(dot(a, ce)), dot(e, ab), hn::Neg(dot(c, ab)),
        hn::Max(hn::Max(farthest_of(a), farthest_of(b)), hn::Max(farthest_of(c), farthest_of(e)))};
}

/// Four numbers of one record in each row; lane 4b + j is in block b of row j.
template <class F>
struct Rows {
    hn::Vec<F> r0, r1, r2, r3;
};

#ifdef TETRALIGHT_HAS_WIDE_VECTORS

/// Reads 16 bytes from `from(lane)` for each lane.
template <class F, class From>
HWY_INLINE hn::Vec<F> load_row(F f, From from, size_t j) {
    const hn::FixedTag<float, 4> four;
    if constexpr (hn::MaxLanes(f) == 4) {
        return hn::LoadU(four, from(j));
    } else if constexpr (hn::MaxLanes(f) == 8) {
        return hn::Combine(f, hn::LoadU(four, from(4 + j)), hn::LoadU(four, from(j)));
    } else {
        const hn::Half<F> half;
        return hn::Combine(
            f, hn::Combine(half, hn::LoadU(four, from(12 + j)), hn::LoadU(four, from(8 + j))),
            hn::Combine(half, hn::LoadU(four, from(4 + j)), hn::LoadU(four, from(j))));
    }
}

/// Rows to columns or back, in each block of four lanes.
template <class F>
HWY_INLINE Rows<F> transpose(F f, const Rows<F>& rows) {
    const hn::Repartition<double, F> pairs;
    const auto ab_low = hn::BitCast(pairs, hn::InterleaveLower(f, rows.r0, rows.r1));
    const auto ab_high = hn::BitCast(pairs, hn::InterleaveUpper(f, rows.r0, rows.r1));
    const auto cd_low = hn::BitCast(pairs, hn::InterleaveLower(f, rows.r2, rows.r3));
    const auto cd_high = hn::BitCast(pairs, hn::InterleaveUpper(f, rows.r2, rows.r3));
    return {hn::BitCast(f, hn::InterleaveLower(pairs, ab_low, cd_low)),
            hn::BitCast(f, hn::InterleaveUpper(pairs, ab_low, cd_low)),
            hn::BitCast(f, hn::InterleaveLower(pairs, ab_high, cd_high)),
            hn::BitCast(f, hn::InterleaveUpper(pairs, ab_high, cd_high))};
}

/// Column k has number k of each lane's record.
template <class F, class From>
HWY_INLINE Rows<F> load_columns(F f, From from) {
    return transpose(f, {load_row(f, from, 0), load_row(f, from, 1), load_row(f, from, 2),
                         load_row(f, from, 3)});
}

/// Reads the positions of the corners of cells, a cell a lane.
template <class F>
class CornerReader {
  public:
    using Indices = hn::Rebind<uint32_t, F>;

    HWY_INLINE explicit CornerReader(const ProbeVolumeView& volume)
        : cells_(volume.cells.data()),
          positions_(&volume.positions[0].x),
          last_probe_(static_cast<uint32_t>(volume.positions.size() - 1)) {}

    /// Finds the first `kCount` corners of the cells of a vector. False unless each is a probe but
    /// not the last one: positions are read as four floats, of the last probe one too many.
    template <int kCount>
    HWY_INLINE bool find_corners(const uint32_t* cells) {
        const F f;
        const Indices du;
        const Rows<F> vertices = load_columns(f, [&](size_t lane) HWY_ATTR {
            return reinterpret_cast<const float*>(cells_[cells[lane]].vertices.data());
        });
        const auto v0 = hn::BitCast(du, vertices.r0), v1 = hn::BitCast(du, vertices.r1);
        const auto v2 = hn::BitCast(du, vertices.r2), v3 = hn::BitCast(du, vertices.r3);
        auto last = hn::Max(hn::Max(v0, v1), v2);
        if constexpr (kCount == 4) last = hn::Max(last, v3);
        const auto thrice = [&](auto v) HWY_ATTR { return hn::Add(hn::Add(v, v), v); };
        hn::Store(thrice(v0), du, places_[0].data());
        hn::Store(thrice(v1), du, places_[1].data());
        hn::Store(thrice(v2), du, places_[2].data());
        hn::Store(thrice(v3), du, places_[3].data());
        read_from_memory(places_.data());
        return hn::AllTrue(du, hn::Lt(last, hn::Set(du, last_probe_)));
    }

    /// x, y, z of one corner of each cell.
    HWY_INLINE Rows<F> load(size_t corner) const {
        return load_columns(
            F(), [&](size_t lane) HWY_ATTR { return positions_ + places_[corner][lane]; });
    }

  private:
    const Cell* cells_;
    const float* positions_;
    uint32_t last_probe_;
    /// Of the floats of each corner.
    alignas(64) std::array<std::array<uint32_t, hn::MaxLanes(F())>, 4> places_;
};

template <class D, class V>
HWY_INLINE Vec3<hn::Vec<D>> promote(D d, V x, V y, V z) {
    return {hn::PromoteTo(d, x), hn::PromoteTo(d, y), hn::PromoteTo(d, z)};
}

/// The first three columns, in double.
template <class D, class F>
HWY_INLINE Vec3<hn::Vec<D>> promote(D d, const Rows<F>& columns) {
    return promote(d, columns.r0, columns.r1, columns.r2);
}

/// Local positions of a vector of queries.
template <class D>
HWY_INLINE Vec3<hn::Vec<D>> load_queries(D d, const QueryBlock& block, const uint32_t* queries) {
    const hn::Rebind<float, D> f;
    const auto position = promote(
        d, load_columns(f, [&](size_t lane) HWY_ATTR { return &block.position[queries[lane]].x; }));
    return subtract(position, {hn::Set(d, block.world_origin.x), hn::Set(d, block.world_origin.y),
                               hn::Set(d, block.world_origin.z)});
}

#endif

}  // namespace tetralight::detail::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#endif
