// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/light_group_sum.h>

#include <array>

namespace tetralight {

void LightGroupSum::add(glm::vec3 direction, const PathLightGroups& path, double weight) {
    for (uint32_t layer = 0; layer < path.layer_count(); ++layer) {
        add(direction, layer, path.radiance(layer), weight);
    }
    const bool has_escaped = path.escape().throughput != glm::vec3(0.0f);
    if (layout_.has_transfer && has_escaped) add_escape(direction, path.escape(), weight);
}

void LightGroupSum::add(glm::vec3 direction, uint32_t layer, glm::vec3 radiance, double weight) {
    if (layer >= layout_.layer_count || radiance == glm::vec3(0.0f)) return;
    const auto basis = sh_basis(direction);
    double* row = sums_.data() + layer * LightGroupLayout::kLayerSize;
    for (const float y : basis) {
        for (int channel = 0; channel < 3; ++channel) {
            *row++ += weight * static_cast<double>(y) * static_cast<double>(radiance[channel]);
        }
    }
}

void LightGroupSum::add_escape(glm::vec3 direction, const PathLightGroups::Escape& escape,
                               double weight) {
    const auto from = distant_basis(escape.direction);
    const auto to = sh_basis(direction);
    std::array<double, 3 * from.size()> arriving;
    size_t count = 0;
    for (const float y : from) {
        if (escape.is_direct) {
            arriving[count++] = weight * static_cast<double>(y);
            continue;
        }
        for (int channel = 0; channel < 3; ++channel) {
            arriving[count++] =
                weight * static_cast<double>(y) * static_cast<double>(escape.throughput[channel]);
        }
    }
    double* row =
        sums_.data() + (escape.is_direct ? layout_.direct_begin() : layout_.bounced_begin());
    for (const float y : to) {
        for (size_t i = 0; i < count; ++i) row[i] += static_cast<double>(y) * arriving[i];
        row += count;
    }
}

}  // namespace tetralight
