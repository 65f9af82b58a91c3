// SPDX-License-Identifier: Apache-2.0
#include <tetralight/reflection/relight_reflections.h>

#include <algorithm>
#include <utility>
#include <vector>

#include <tetralight/base/half.h>
#include <tetralight/reflection/cube.h>

namespace tetralight {
namespace {

constexpr double kLargestHalf = 65504.0;

/// Rewrites the texels of one level: of each probe `count`. Returns the share of their light that
/// halves cannot hold.
double relight_level(const std::vector<ReflectionLayer>& layers, size_t count,
                     std::span<const RadianceTexel> light_of_layers,
                     std::span<RadianceTexel> texels) {
    double all = 0.0, clamped = 0.0;
    for (size_t i = 0; i < texels.size(); ++i) {
        const size_t probe = i / count, texel = i % count;
        glm::vec3 sum(0.0f);
        for (size_t k = 0; k < layers.size(); ++k) {
            const RadianceTexel& light =
                light_of_layers[(probe * layers.size() + k) * count + texel];
            sum +=
                layers[k].weight * glm::vec3(float_from_half(light[0]), float_from_half(light[1]),
                                             float_from_half(light[2]));
        }
        for (int channel = 0; channel < 3; ++channel) {
            texels[i][static_cast<size_t>(channel)] = half_from_float_saturated(sum[channel]);
            all += double{sum[channel]};
            clamped += std::max(0.0, double{sum[channel]} - kLargestHalf);
        }
    }
    return all > 0.0 ? clamped / all : 0.0;
}

}  // namespace

Result<double> relight_reflections(Reflections& reflections, std::span<const LayerWeight> changes) {
    std::vector<ReflectionLayer>& layers = reflections.layers;
    std::vector<float> before;
    for (const ReflectionLayer& layer : layers) before.push_back(layer.weight);
    const auto weights = changed_weights(reflections.layer_names, std::move(before), changes);
    if (!weights) return weights.error();
    for (size_t k = 0; k < layers.size(); ++k) layers[k].weight = (*weights)[k];
    if (layers.empty()) return 0.0;
    double clamped_share = 0.0;
    for (uint32_t level = 0; level < reflections.levels.size(); ++level) {
        const size_t size = reflections.size >> level;
        const double share =
            relight_level(layers, kCubeFaceCount * size * size, reflections.layer_levels[level],
                          reflections.levels[level]);
        if (level == 0) clamped_share = share;
    }
    for (size_t i = 0; i < reflections.probes.size(); ++i) {
        IrradianceSh sum{};
        for (size_t k = 0; k < layers.size(); ++k) {
            IrradianceSh part = reflections.layer_irradiance[i * layers.size() + k];
            part *= layers[k].weight;
            sum += part;
        }
        reflections.probes[i].irradiance = sum;
    }
    return clamped_share;
}

}  // namespace tetralight
