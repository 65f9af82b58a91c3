// SPDX-License-Identifier: Apache-2.0
// Highway includes this file once for each instruction set.
#include <tetralight/runtime/detail/sample_kernel.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE <tetralight/runtime/detail/sample_kernel.cpp>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace tetralight::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Nine fused multiply-adds a channel, in three chains of three.
template <class Tag, class Vec>
HWY_INLINE Vec evaluate(Tag tag, const NormalPolynomial& p, Vec x, Vec y, Vec z) {
    const auto all = [&](float value) { return hn::Set(tag, value); };
    const Vec of_x =
        hn::MulAdd(all(p.xx), x, hn::MulAdd(all(p.xy), y, hn::MulAdd(all(p.xz), z, all(p.x1))));
    const Vec of_y = hn::NegMulAdd(all(p.xx), y, hn::MulAdd(all(p.yz), z, all(p.y1)));
    const Vec of_z = hn::MulAdd(all(p.zz), z, all(p.z1));
    return hn::MulAdd(x, of_x, hn::MulAdd(y, of_y, hn::MulAdd(z, of_z, all(p.constant))));
}

void sample(const NormalPolynomial* polynomials, const NormalArrays& arrays, size_t count) {
    const hn::ScalableTag<float> tag;
    const size_t lanes = hn::Lanes(tag);
    const NormalPolynomial red = polynomials[0], green = polynomials[1], blue = polynomials[2];
    const NormalArrays at = arrays;
    size_t i = 0;
    for (; i + lanes <= count; i += lanes) {
        const auto x = hn::LoadU(tag, at.x + i);
        const auto y = hn::LoadU(tag, at.y + i);
        const auto z = hn::LoadU(tag, at.z + i);
        hn::StoreU(evaluate(tag, red, x, y, z), tag, at.red + i);
        hn::StoreU(evaluate(tag, green, x, y, z), tag, at.green + i);
        hn::StoreU(evaluate(tag, blue, x, y, z), tag, at.blue + i);
    }
    sample_rest(polynomials, at, i, count);
}

}  // namespace tetralight::detail::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tetralight::detail {

namespace {

HWY_EXPORT(sample);

}  // namespace

void sample_fastest(const NormalPolynomial* polynomials, const NormalArrays& arrays,
                    size_t count) noexcept {
    HWY_DYNAMIC_DISPATCH(sample)(polynomials, arrays, count);
}

}  // namespace tetralight::detail
#endif
