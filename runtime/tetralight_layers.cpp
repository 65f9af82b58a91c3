// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstring>

#include <tetralight/probes/recombine.h>
#include <tetralight/runtime/detail/c_arrays.h>
#include <tetralight/runtime/detail/c_volume.h>
#include <tetralight/runtime/tetralight.h>

namespace {

using namespace tetralight;
using detail::check_array;
using detail::check_memory;
using detail::check_pointer;
using detail::finish;
using detail::succeed;
using detail::view_of;

/// Bytes that `store_light` allocates.
size_t memory_of_light(const tetralight_volume& volume) {
    const ProbeVolumeView& from = volume.source;
    size_t bytes = sizeof(Layer) * from.layers.size();
    if (volume.irradiance.empty()) bytes += from.irradiance.size_bytes();
    if (volume.compact.empty()) bytes += from.compact.size_bytes();
    return bytes;
}

/// The light of the file's layers with these weights, in place of what queries read.
void store_light(tetralight_volume& volume, std::span<const float> weights,
                 const RecombinedInfo& info) {
    const ProbeVolumeView& from = volume.source;
    const size_t count = from.positions.size();
    if (from.irradiance.size() == count) volume.irradiance.resize(count);
    if (from.compact.size() == count && volume.compact.empty()) {
        volume.compact.assign(from.compact.begin(), from.compact.end());
    }
    recombine_probes(from, weights, 0, count, volume.irradiance, volume.compact,
                     info.compact_scale);
    volume.layers.assign(from.layers.begin(), from.layers.end());
    for (size_t k = 0; k < weights.size(); ++k) volume.layers[k].weight = weights[k];
    if (!volume.irradiance.empty()) volume.view.irradiance = volume.irradiance;
    if (!volume.compact.empty()) {
        volume.view.compact = volume.compact;
        volume.view.info.compact_scale = info.compact_scale;
    }
    volume.view.layers = volume.layers;
    volume.view.info.ambient = info.ambient;
}

}  // namespace

tetralight_status tetralight_get_layer(const tetralight_volume* volume, uint32_t index,
                                       tetralight_layer* layer, tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("volume", volume)) return finish(wrong, error);
    if (auto wrong = check_pointer("layer", layer)) return finish(wrong, error);
    const ProbeVolumeView& view = view_of(*volume);
    const auto names = split_names(view.layer_names);
    if (index >= view.layers.size() || index >= names.size()) {
        return finish({TETRALIGHT_NOT_THERE,
                       str_cat("there is no layer ", index, " of ", view.layers.size())},
                      error);
    }
    const size_t length = std::min(names[index].size(), sizeof layer->name - 1);
    std::memcpy(layer->name, names[index].data(), length);
    layer->name[length] = '\0';
    layer->weight = view.layers[index].weight;
    return succeed(error);
}

tetralight_status tetralight_recombine(tetralight_volume* volume, const float* weights,
                                       size_t weight_count, tetralight_error* error) noexcept {
    if (auto wrong = check_pointer("volume", volume)) return finish(wrong, error);
    const ProbeVolumeView& from = volume->source;
    if (from.layers.empty()) {
        return finish({TETRALIGHT_NOT_THERE, "the volume holds no layers"}, error);
    }
    if (weight_count < from.layers.size()) {
        return finish({TETRALIGHT_SHORT_BUFFER,
                       str_cat(weight_count, " weights for ", from.layers.size(), " layers")},
                      error);
    }
    const tetralight_const_array array{weights, weight_count * sizeof(float), 0};
    if (auto wrong = check_array("weights", array, weight_count, {4, 4})) {
        return finish(wrong, error);
    }
    const std::span<const float> each(weights, weight_count);
    const auto info = check_weights(from, each);
    if (!info) return finish(info.error(), error);
    if (auto wrong = check_memory("the light of the layers", memory_of_light(*volume))) {
        return finish(wrong, error);
    }
    store_light(*volume, each, *info);
    return succeed(error);
}
