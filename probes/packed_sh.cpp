// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/packed_sh.h>

#include <array>
#include <glm/geometric.hpp>

namespace tetralight {

PackedSh pack_sh(const IrradianceSh& irradiance) noexcept {
    // K_i / π: the basis constant of each polynomial, over Lambert's π.
    constexpr std::array<float, kShCoefficientCount> scale{0.08979356f, 0.15552701f, 0.15552701f,
                                                           0.15552701f, 0.34776897f, 0.34776897f,
                                                           0.10039225f, 0.34776897f, 0.17388448f};
    std::array<glm::vec3, kShCoefficientCount> s;
    for (int i = 0; i < kShCoefficientCount; ++i) s[i] = irradiance.coefficients[i] * scale[i];

    const auto sha = [&](int channel) {
        return glm::vec4(s[3][channel], s[1][channel], s[2][channel],
                         s[0][channel] - s[6][channel]);
    };
    const auto shb = [&](int channel) {
        return glm::vec4(s[4][channel], s[5][channel], 3.0f * s[6][channel], s[7][channel]);
    };
    return {sha(0), sha(1), sha(2), shb(0), shb(1), shb(2), glm::vec4(s[8], 1.0f)};
}

glm::vec3 sample_sh9(const PackedSh& sh, glm::vec3 normal) noexcept {
    const glm::vec4 linear(normal, 1.0f);
    const glm::vec4 quadratic(normal.x * normal.y, normal.y * normal.z, normal.z * normal.z,
                              normal.z * normal.x);
    const float square = normal.x * normal.x - normal.y * normal.y;
    return glm::vec3(glm::dot(sh.sha_r, linear) + glm::dot(sh.shb_r, quadratic),
                     glm::dot(sh.sha_g, linear) + glm::dot(sh.shb_g, quadratic),
                     glm::dot(sh.sha_b, linear) + glm::dot(sh.shb_b, quadratic)) +
           glm::vec3(sh.shc) * square;
}

}  // namespace tetralight
