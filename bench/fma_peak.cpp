// SPDX-License-Identifier: Apache-2.0
// Highway includes this file once for each instruction set.
#include <tetralight/bench/fma_peak.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE <tetralight/bench/fma_peak.cpp>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace tetralight::bench::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

float multiply_add(size_t count) {
    const hn::ScalableTag<float> tag;
    using Vec = hn::Vec<decltype(tag)>;
    constexpr size_t kChains = 12;
    const Vec factor = hn::Set(tag, 0.999f), term = hn::Set(tag, 0.001f);
    // Different values, so that the compiler cannot merge chains.
    const auto start = [&](float value) { return hn::Set(tag, value); };
    Vec a = start(1), b = start(2), c = start(3), d = start(4), e = start(5), f = start(6);
    Vec g = start(7), h = start(8), i = start(9), j = start(10), k = start(11), l = start(12);
    const size_t rounds = count / (kChains * hn::Lanes(tag));
    for (size_t round = 0; round < rounds; ++round) {
        a = hn::MulAdd(a, factor, term);
        b = hn::MulAdd(b, factor, term);
        c = hn::MulAdd(c, factor, term);
        d = hn::MulAdd(d, factor, term);
        e = hn::MulAdd(e, factor, term);
        f = hn::MulAdd(f, factor, term);
        g = hn::MulAdd(g, factor, term);
        h = hn::MulAdd(h, factor, term);
        i = hn::MulAdd(i, factor, term);
        j = hn::MulAdd(j, factor, term);
        k = hn::MulAdd(k, factor, term);
        l = hn::MulAdd(l, factor, term);
    }
    const Vec first = hn::Add(hn::Add(hn::Add(a, b), hn::Add(c, d)), hn::Add(e, f));
    const Vec second = hn::Add(hn::Add(hn::Add(g, h), hn::Add(i, j)), hn::Add(k, l));
    return hn::GetLane(hn::Add(first, second));
}

}  // namespace tetralight::bench::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tetralight::bench {

HWY_EXPORT(multiply_add);

float multiply_add(size_t count) {
    return HWY_DYNAMIC_DISPATCH(multiply_add)(count);
}

}  // namespace tetralight::bench
#endif
