// SPDX-License-Identifier: Apache-2.0
// Compiled once for each kind of processor: Highway includes this file again and again.
#include <tetralight/probes/detail/vector_kernels.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE <tetralight/probes/detail/volume_kernel.cpp>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <tetralight/probes/detail/vectors-inl.h>

HWY_BEFORE_NAMESPACE();

namespace tetralight::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#ifdef TETRALIGHT_HAS_WIDE_VECTORS

using Doubles = hn::CappedTag<double, CellLanes::kCount>;
using Floats = hn::Rebind<float, Doubles>;
using VecD = hn::Vec<Doubles>;

/// The lanes from `lane` on.
HWY_INLINE void measure_from(CornerReader<Floats>& reader, const QueryBlock& block,
                             const CellList& list, size_t begin, size_t lane, CellLanes& lanes) {
    const Doubles d;
    const uint32_t* cells = &list.cell[begin + lane];
    const bool is_known = reader.find_corners<4>(cells);
    for (size_t i = 0; i < hn::Lanes(d); ++i) lanes.is_known[lane + i] = is_known;
    if (HWY_UNLIKELY(!is_known)) return;
    const Vec3<VecD> query = load_queries(d, block, &list.query[begin + lane]);
    const auto corner = [&](size_t k)
                            HWY_ATTR { return subtract(promote(d, reader.load(k)), query); };
    const auto volumes = signed_volumes(corner(0), corner(1), corner(2), corner(3));
    hn::Store(volumes.w0, d, &lanes.values[0][lane]);
    hn::Store(volumes.w1, d, &lanes.values[1][lane]);
    hn::Store(volumes.w2, d, &lanes.values[2][lane]);
    hn::Store(volumes.w3, d, &lanes.values[3][lane]);
    hn::Store(volumes.farthest, d, &lanes.farthest[lane]);
}

void measure_tetrahedra(const ProbeVolumeView& volume, const QueryBlock& block,
                        const CellList& list, size_t begin, CellLanes& lanes) {
    CornerReader<Floats> reader(volume);
    for (size_t lane = 0; lane < CellLanes::kCount && begin + lane < list.count;
         lane += hn::Lanes(Doubles())) {
        measure_from(reader, block, list, begin, lane, lanes);
    }
}

#else

void measure_tetrahedra(const ProbeVolumeView& volume, const QueryBlock& block,
                        const CellList& list, size_t begin, CellLanes& lanes) {
    scalar_kernels().measure_tetrahedra(volume, block, list, begin, lanes);
}

#endif

}  // namespace tetralight::detail::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace tetralight::detail {

HWY_EXPORT(measure_tetrahedra);

void measure_tetrahedra_in_vectors(const ProbeVolumeView& volume, const QueryBlock& block,
                                   const CellList& list, size_t begin, CellLanes& lanes) {
    HWY_DYNAMIC_DISPATCH(measure_tetrahedra)(volume, block, list, begin, lanes);
}

}  // namespace tetralight::detail

#endif
