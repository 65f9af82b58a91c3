// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/light_group_sum.h>

#include <array>

namespace tetralight {

void LightGroupSum::add(glm::vec3 direction, const PathLightGroups& split, double weight) {
    for (uint32_t layer = 0; layer < split.layer_count(); ++layer) {
        add(direction, layer, split.radiance(layer), weight);
    }
    const bool is_out = split.exit().throughput != glm::vec3(0.0f);
    if (layout_.has_transfer && is_out) add_exit(direction, split.exit(), weight);
}

void LightGroupSum::add(glm::vec3 direction, uint32_t layer, glm::vec3 radiance, double weight) {
    if (layer >= layout_.layer_count || radiance == glm::vec3(0.0f)) return;
    const auto basis = sh_basis(direction);
    double* row = sums_.data() + layer * LightGroupLayout::kLayer;
    for (const float y : basis) {
        for (int channel = 0; channel < 3; ++channel) {
            *row++ += weight * static_cast<double>(y) * static_cast<double>(radiance[channel]);
        }
    }
}

void LightGroupSum::add_exit(glm::vec3 direction, const PathLightGroups::Exit& exit,
                             double weight) {
    const auto from = distant_basis(exit.direction);
    const auto to = sh_basis(direction);
    std::array<double, 3 * from.size()> arriving;
    size_t count = 0;
    for (const float y : from) {
        if (exit.is_direct) {
            arriving[count++] = weight * static_cast<double>(y);
            continue;
        }
        for (int channel = 0; channel < 3; ++channel) {
            arriving[count++] =
                weight * static_cast<double>(y) * static_cast<double>(exit.throughput[channel]);
        }
    }
    double* row =
        sums_.data() + (exit.is_direct ? layout_.direct_begin() : layout_.bounced_begin());
    for (const float y : to) {
        for (size_t i = 0; i < count; ++i) row[i] += static_cast<double>(y) * arriving[i];
        row += count;
    }
}

}  // namespace tetralight
