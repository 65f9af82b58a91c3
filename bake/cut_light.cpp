// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/cut_light.h>

#include <algorithm>

namespace tetralight {

void CutLight::add(const CutLight& other) noexcept {
    last_radiance += other.last_radiance;
    last_throughput += other.last_throughput;
    cut_throughput += other.cut_throughput;
}

glm::dvec3 CutLight::lost_radiance() const noexcept {
    constexpr double kMaxRatio = 0.999;
    if (last_throughput <= 0.0) return glm::dvec3(0.0);
    const double ratio = std::min(cut_throughput / last_throughput, kMaxRatio);
    return ratio / (1.0 - ratio) * last_radiance;
}

}  // namespace tetralight
