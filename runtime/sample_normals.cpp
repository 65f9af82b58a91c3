// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/sample_normals.h>

#include <tetralight/base/contract.h>
#include <tetralight/runtime/detail/sample_kernel.h>

namespace tetralight {
namespace {

/// E(n)/π as a polynomial in x, y and z, in the form with the fewest products.
detail::NormalPolynomial polynomial_of(const PackedSh& sh, int channel) {
    const glm::vec4& a = channel == 0 ? sh.sha_r : channel == 1 ? sh.sha_g : sh.sha_b;
    const glm::vec4& b = channel == 0 ? sh.shb_r : channel == 1 ? sh.shb_g : sh.shb_b;
    return {a.w, a.x, sh.shc[channel], b.x, b.w, a.y, b.y, a.z, b.z};
}

}  // namespace

void sample_sh9(const PackedSh& sh, const NormalSpans& normals, const LightSpans& light) noexcept {
    const size_t count = normals.x.size();
    TETRALIGHT_ASSERT(normals.y.size() >= count && normals.z.size() >= count,
                      "each normal has three coordinates");
    TETRALIGHT_ASSERT(
        light.red.size() >= count && light.green.size() >= count && light.blue.size() >= count,
        "each normal has an answer");
    const detail::NormalPolynomial polynomials[] = {polynomial_of(sh, 0), polynomial_of(sh, 1),
                                                    polynomial_of(sh, 2)};
    const detail::NormalArrays arrays{normals.x.data(), normals.y.data(),   normals.z.data(),
                                      light.red.data(), light.green.data(), light.blue.data()};
#ifdef TETRALIGHT_HAS_HIGHWAY
    detail::sample_fastest(polynomials, arrays, count);
#else
    detail::sample_rest(polynomials, arrays, 0, count);
#endif
}

}  // namespace tetralight
