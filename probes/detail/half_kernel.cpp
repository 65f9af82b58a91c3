// SPDX-License-Identifier: Apache-2.0
// Compiled once for each kind of processor: Highway includes this file again and again.
#include <tetralight/probes/detail/half_kernel.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE <tetralight/probes/detail/half_kernel.cpp>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace tetralight::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void write_halves(std::span<const float> floats, uint16_t* to) {
#if HWY_MAX_BYTES >= 32  // narrower processors round halves otherwise
    const hn::CappedTag<float, 16> lanes;
    const hn::Rebind<hwy::float16_t, decltype(lanes)> halves;
    const size_t step = hn::Lanes(lanes);
    const size_t count = floats.size();
    if (count >= step) {
        for (size_t i = 0; i < count; i += step) {
            const size_t at = i + step <= count ? i : count - step;  // the last one overlaps
            hn::StoreU(hn::DemoteTo(halves, hn::LoadU(lanes, floats.data() + at)), halves,
                       reinterpret_cast<hwy::float16_t*>(to + at));
        }
        return;
    }
#endif
    write_halves_scalar(floats, to);
}

}  // namespace tetralight::detail::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace tetralight::detail {

HWY_EXPORT(write_halves);

void write_halves_in_vectors(std::span<const float> floats, uint16_t* halves) noexcept {
    HWY_DYNAMIC_DISPATCH(write_halves)(floats, halves);
}

}  // namespace tetralight::detail

#endif
