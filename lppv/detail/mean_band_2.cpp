// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lppv/detail/mean_band_2.h>

#include <array>

namespace tetralight::detail {

IrradianceSh mean_band_2(std::span<const IrradianceSh> irradiance) noexcept {
    std::array<glm::dvec3, kShCoefficientCount> sum{};
    for (const IrradianceSh& sh : irradiance) {
        for (int i = kFirstOfBand2; i < kShCoefficientCount; ++i) {
            sum[i] += glm::dvec3(sh.coefficients[i]);
        }
    }
    IrradianceSh mean;
    for (int i = kFirstOfBand2; i < kShCoefficientCount; ++i) {
        mean.coefficients[i] = glm::vec3(sum[i] / static_cast<double>(irradiance.size()));
    }
    return mean;
}

}  // namespace tetralight::detail
