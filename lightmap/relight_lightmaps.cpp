// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lightmap/relight_lightmaps.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <tetralight/base/str_cat.h>
#include <tetralight/lightmap/detail/texel_values.h>
#include <tetralight/probes/layer.h>

namespace tetralight {
namespace {

using detail::TexelValues;
using detail::values_of;

/// The largest finite half.
constexpr float kLargestHalf = 65504.0f;

/// Weights before and after, and the scales of the halves.
struct WeightChange {
    std::vector<LightmapLayer> layers;  ///< with the weights before
    std::vector<float> weights;
    float scale = 1.0f;
    float smallest_rest = 0.0f;  ///< the step of the smallest halves, of all layers
};

WeightChange make_change(const Lightmaps& lightmaps, std::vector<float> weights) {
    WeightChange change{lightmaps.layers, std::move(weights), lightmaps.info.scale, 0.0f};
    constexpr float kSmallestStep = 0x1p-24f;
    float steps = change.scale;
    for (const LightmapLayer& layer : change.layers) steps += layer.weight * layer.scale;
    change.smallest_rest = kSmallestStep * steps;
    return change;
}

/// The values of one texel with the new weights. Layer k begins at layers[k · texel count].
template <class Texel, class Layer>
auto relit(const WeightChange& change, std::span<const Texel> texels, std::span<const Layer> layers,
           size_t texel) noexcept {
    auto rest = values_of(texels[texel], change.scale);
    decltype(rest) size{}, sum{};
    for (size_t i = 0; i < rest.size(); ++i) size[i] = std::abs(rest[i]);
    for (size_t k = 0; k < change.layers.size(); ++k) {
        const auto layer = values_of(layers[k * texels.size() + texel], change.layers[k].scale);
        for (size_t i = 0; i < rest.size(); ++i) {
            const float part = change.layers[k].weight * layer[i];
            rest[i] -= part;
            size[i] += std::abs(part);
            sum[i] += change.weights[k] * layer[i];
        }
    }
    constexpr float kHalfRounding = 0x1p-10f;  // twice that of the values, for sums of floats
    for (size_t i = 0; i < rest.size(); ++i) {
        const bool is_rounding =
            std::abs(rest[i]) <= kHalfRounding * size[i] + change.smallest_rest;
        sum[i] += is_rounding ? 0.0f : rest[i];
    }
    return sum;
}

/// The largest magnitude of all relit values; infinite if one is not finite.
template <class Texel, class Layer>
float largest_relit(const WeightChange& change, std::span<const Texel> texels,
                    std::span<const Layer> layers) noexcept {
    float largest = 0.0f;
    for (size_t texel = 0; texel < texels.size(); ++texel) {
        for (const float value : relit(change, texels, layers, texel)) {
            if (!std::isfinite(value)) return INFINITY;
            largest = std::max(largest, std::abs(value));
        }
    }
    return largest;
}

template <class Texel, class Layer>
void write_relit(const WeightChange& change, float scale, std::vector<Texel>& texels,
                 const std::vector<Layer>& layers) noexcept {
    const std::span<const Texel> before = texels;
    for (size_t texel = 0; texel < texels.size(); ++texel) {
        const auto values = relit(change, before, std::span(layers), texel);
        detail::store_values(values, scale, texels[texel]);
    }
}

Status check_layer_texels(const Lightmaps& lightmaps) {
    const size_t layers = lightmaps.layers.size(), texels = lightmaps.irradiance.size();
    const uint64_t expected = layer_element_count(layers, texels);
    const auto wrong = [&](const char* section, size_t count) {
        return Error{ErrorCode::Corrupt, section, "",
                     str_cat("section \"", section, "\": ", count, " elements for ", layers,
                             " layers of ", texels, " texels")};
    };
    if (lightmaps.layer_irradiance.size() != expected) {
        return wrong("layer_irradiance", lightmaps.layer_irradiance.size());
    }
    if (!lightmaps.light.empty() && lightmaps.light.size() != texels) {
        return wrong("light", lightmaps.light.size());
    }
    if (!lightmaps.layer_light.empty() && lightmaps.layer_light.size() != expected) {
        return wrong("layer_light", lightmaps.layer_light.size());
    }
    return Ok{};
}

void relight_texels(const WeightChange& change, float scale, Lightmaps& lightmaps) noexcept {
    write_relit(change, scale, lightmaps.irradiance, lightmaps.layer_irradiance);
    write_relit(change, scale, lightmaps.light, lightmaps.layer_light);
    lightmaps.info.scale = scale;
    for (size_t k = 0; k < lightmaps.layers.size(); ++k) {
        lightmaps.layers[k].weight = change.weights[k];
    }
}

}  // namespace

Status relight_lightmaps(Lightmaps& lightmaps, std::span<const LayerWeight> changes) {
    std::vector<float> before;
    for (const LightmapLayer& layer : lightmaps.layers) before.push_back(layer.weight);
    auto weights = changed_weights(lightmaps.layer_names, before, changes);
    if (!weights) return weights.error();
    if (*weights == before) return Ok{};
    if (auto status = check_layer_texels(lightmaps); !status) return status;
    const LightmapsView view = lightmaps.view();
    const bool has_light = !view.light.empty() && !view.layer_light.empty();
    const WeightChange change = make_change(lightmaps, std::move(*weights));
    float largest = largest_relit(change, view.irradiance, view.layer_irradiance);
    if (has_light) largest = std::max(largest, largest_relit(change, view.light, view.layer_light));
    if (!(largest <= kLargestHalf * kLargestLightmapScale)) {
        return Error{ErrorCode::InvalidArgument, "weights", "",
                     "the weights make the light too bright for lightmaps"};
    }
    if (!has_light) lightmaps.light.clear();
    const bool is_held = largest <= kLargestHalf * change.scale;
    relight_texels(change, is_held ? change.scale : lightmap_scale(largest), lightmaps);
    return Ok{};
}

}  // namespace tetralight
