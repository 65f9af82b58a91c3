// SPDX-License-Identifier: Apache-2.0
// Compiled once for each kind of processor: Highway includes this file again and again.
#include <tetralight/probes/detail/recombine_kernel.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE <tetralight/probes/detail/recombine_kernel.cpp>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace tetralight::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void recombine(const RecombineBlock& block) {
    size_t i = 0;
#if HWY_MAX_BYTES >= 32  // narrower processors round halves otherwise
    const hn::CappedTag<float, 16> lanes;
    const hn::Rebind<hwy::float16_t, decltype(lanes)> halves;
    const size_t step = hn::Lanes(lanes);
    const size_t layer_count = block.weights.size();
    for (; i + step <= block.count; i += step) {
        auto sum = hn::Mul(hn::Set(lanes, block.weights[0]), hn::LoadU(lanes, block.layers + i));
        for (size_t k = 1; k < layer_count; ++k) {
            const float* layer = block.layers + k * block.layer_stride + i;
            sum = hn::Add(sum, hn::Mul(hn::Set(lanes, block.weights[k]), hn::LoadU(lanes, layer)));
        }
        hn::StoreU(sum, lanes, block.sums + i);
        if (block.halves == nullptr) continue;
        const auto scaled = hn::Mul(sum, hn::Set(lanes, block.half_factor));
        hn::StoreU(hn::DemoteTo(halves, scaled), halves,
                   reinterpret_cast<hwy::float16_t*>(block.halves + i));
    }
#endif
    RecombineBlock rest = block;
    rest.layers += i;
    rest.sums += i;
    rest.count -= i;
    if (rest.halves != nullptr) rest.halves += i;
    recombine_floats(rest);
}

}  // namespace tetralight::detail::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace tetralight::detail {

HWY_EXPORT(recombine);

void recombine_floats_in_vectors(const RecombineBlock& block) noexcept {
    HWY_DYNAMIC_DISPATCH(recombine)(block);
}

}  // namespace tetralight::detail

#endif
