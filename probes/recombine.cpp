// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/recombine.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

#include <tetralight/base/str_cat.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/detail/recombine_kernel.h>

namespace tetralight {
namespace {

constexpr size_t kFloats = 3 * size_t{kShCoefficientCount};

/// Probes whose sums fit beside the layers they come from in the fastest cache.
constexpr size_t kBlockSize = 32;

std::string listed(std::span<const std::string_view> layers) {
    std::string names;
    for (const std::string_view name : layers) {
        names += str_cat(names.empty() ? "" : ", ", "\"", name, "\"");
    }
    return names.empty() ? "it holds no layers" : "it holds " + names;
}

Status check_weight(std::string_view name, float weight) {
    if (std::isfinite(weight) && weight >= 0.0f) return Ok{};
    return Error{ErrorCode::InvalidArgument, "weights", str_cat(weight),
                 str_cat("layer \"", name, "\": weight ", weight, " is ",
                         std::isnan(weight) ? "not a number"
                         : weight < 0.0f    ? "negative"
                                            : "not finite")};
}

/// True if a name is that of a layer, or the part after its colon.
bool is_short_for(std::string_view name, std::string_view layer) {
    const size_t colon = layer.find(':');
    return name == layer || (colon != std::string_view::npos && name == layer.substr(colon + 1));
}

Result<size_t> find_named(std::span<const std::string_view> names, std::string_view name) {
    const auto index = [&](auto place) { return static_cast<size_t>(place - names.begin()); };
    if (const auto exact = std::ranges::find(names, name); exact != names.end())
        return index(exact);
    const auto is_meant = [&](std::string_view layer) { return is_short_for(name, layer); };
    const auto count = std::ranges::count_if(names, is_meant);
    if (count == 1) return index(std::ranges::find_if(names, is_meant));
    return Error{count == 0 ? ErrorCode::NotFound : ErrorCode::InvalidArgument, "weights",
                 std::string(name),
                 str_cat(count == 0 ? "there is no layer \"" : "there are several layers \"", name,
                         "\"; ", listed(names))};
}

Error too_bright(std::string_view layer, float weight) {
    return {ErrorCode::InvalidArgument, "weights", str_cat(weight),
            str_cat("layer \"", layer, "\": weight ", weight,
                    " makes its light too bright to be finite")};
}

}  // namespace

std::vector<float> layer_weights(const ProbeVolumeView& volume) {
    std::vector<float> weights;
    for (const Layer& layer : volume.layers) weights.push_back(layer.weight);
    return weights;
}

Result<std::vector<float>> changed_weights(std::string_view layer_names, std::vector<float> weights,
                                           std::span<const LayerWeight> changes) {
    const std::vector<std::string_view> names = split_names(layer_names);
    std::vector<bool> is_changed(weights.size(), false);
    for (const LayerWeight& change : changes) {
        const auto layer = find_named(names, change.name);
        if (!layer) return layer.error();
        if (auto status = check_weight(change.name, change.weight); !status) return status.error();
        if (*layer >= weights.size()) continue;
        if (is_changed[*layer]) {
            return Error{ErrorCode::InvalidArgument, "weights", std::string(change.name),
                         str_cat("layer \"", change.name, "\" is given two weights")};
        }
        is_changed[*layer] = true;
        weights[*layer] = change.weight;
    }
    return weights;
}

Result<std::vector<float>> layer_weights(const ProbeVolumeView& volume,
                                         std::span<const LayerWeight> changes) {
    return changed_weights(volume.layer_names, layer_weights(volume), changes);
}

uint32_t find_layer(const ProbeVolumeView& volume, std::string_view name) noexcept {
    const auto names = split_names(volume.layer_names);
    const auto index = static_cast<size_t>(std::ranges::find(names, name) - names.begin());
    // A volume that was not verified may have more names than layers.
    const size_t count = std::min(names.size(), volume.layers.size());
    return index < count ? static_cast<uint32_t>(index) : kNoIndex;
}

float light_weight(const ProbeVolumeView& volume, size_t light) noexcept {
    if (light >= volume.light_states.size()) return 1.0f;
    const uint32_t layer = volume.light_states[light].layer;
    return layer < volume.layers.size() ? volume.layers[layer].weight : 1.0f;
}

Result<RecombinedInfo> check_weights(const ProbeVolumeView& volume,
                                     std::span<const float> weights) {
    const size_t layer_count = volume.layers.size();
    if (layer_count == 0) {
        return Error{ErrorCode::InvalidArgument,
                     "the volume holds no layers (bake it with --layers to change its light)"};
    }
    if (volume.layer_irradiance.size() !=
        layer_element_count(layer_count, volume.positions.size())) {
        return Error{ErrorCode::Corrupt, "layer_irradiance", "",
                     str_cat("section \"layer_irradiance\": ", volume.layer_irradiance.size(),
                             " elements for ", layer_count, " layers of ", volume.positions.size(),
                             " probes")};
    }
    if (weights.size() != layer_count) {
        return Error{ErrorCode::InvalidArgument, "weights", "",
                     str_cat(weights.size(), " weights for ", layer_count, " layers")};
    }
    const auto names = split_names(volume.layer_names);
    RecombinedInfo info;
    double bound = 0.0, ambient_bound = 0.0;
    std::pair<double, size_t> brightest;
    for (size_t k = 0; k < layer_count; ++k) {
        const std::string_view name = k < names.size() ? names[k] : "";
        if (auto status = check_weight(name, weights[k]); !status) return status.error();
        const double largest =
            static_cast<double>(weights[k]) * static_cast<double>(volume.layers[k].largest);
        const double ambient =
            static_cast<double>(weights[k]) *
            static_cast<double>(largest_coefficient(std::span(&volume.layers[k].ambient, 1)));
        brightest = std::max(brightest, {std::max(largest, ambient), k});
        bound += largest;
        ambient_bound += ambient;
        info.ambient += weights[k] * volume.layers[k].ambient;
    }
    if (!(std::max(bound, ambient_bound) < double{kLargestCoefficient})) {
        const size_t k = brightest.second;
        return too_bright(k < names.size() ? names[k] : "", weights[k]);
    }
    info.compact_scale = compact_scale(static_cast<float>(bound));
    return info;
}

void recombine_probes(const ProbeVolumeView& volume, std::span<const float> weights, size_t begin,
                      size_t end, std::span<IrradianceSh> irradiance,
                      std::span<CompactProbe> compact, float scale) noexcept {
    std::array<float, kBlockSize * kFloats> sums;
    std::array<uint16_t, kBlockSize * kFloats> halves;
    const auto* layers = reinterpret_cast<const float*>(volume.layer_irradiance.data());
    for (size_t first = begin; first < end; first += kBlockSize) {
        const size_t count = std::min(kBlockSize, end - first);
        const size_t to = first - begin;
        detail::RecombineBlock block;
        block.layers = layers + first * kFloats;
        block.layer_stride = volume.positions.size() * kFloats;
        block.weights = weights;
        block.count = count * kFloats;
        block.sums = irradiance.empty() ? sums.data() : &irradiance[to].coefficients[0].x;
        block.halves = compact.empty() ? nullptr : halves.data();
        block.half_factor = 1.0f / scale;
        detail::recombine_fast(block);
        if (compact.empty()) continue;
        for (size_t i = 0; i < count; ++i) {
            std::memcpy(compact[to + i].irradiance.data(), halves.data() + i * kFloats,
                        sizeof compact[0].irradiance);
        }
    }
}

uint32_t count_wrong_sums(const ProbeVolumeView& volume) noexcept {
    if (volume.layer_irradiance.empty() || volume.irradiance.empty()) return 0;
    const size_t probes = volume.positions.size();
    const auto coefficients = [](const IrradianceSh& sh) {
        return std::span(&sh.coefficients[0].x, kFloats);
    };
    uint32_t count = 0;
    for (size_t probe = 0; probe < probes; ++probe) {
        std::array<double, kFloats> sum{}, magnitude{};
        for (size_t k = 0; k < volume.layers.size(); ++k) {
            const auto part = coefficients(volume.layer_irradiance[k * probes + probe]);
            for (size_t i = 0; i < kFloats; ++i) {
                const double term = double{volume.layers[k].weight} * double{part[i]};
                sum[i] += term;
                magnitude[i] += std::abs(term);
            }
        }
        const auto stored = coefficients(volume.irradiance[probe]);
        constexpr double kRounding = 1e-5;
        bool is_sum = true;
        for (size_t i = 0; i < kFloats; ++i) {
            is_sum &= std::abs(sum[i] - double{stored[i]}) <= kRounding * magnitude[i] + 1e-37;
        }
        count += !is_sum;
    }
    return count;
}

Status recombine(ProbeVolume& volume, std::span<const float> weights) {
    return recombine(volume, weights, [](size_t count, const auto& task) {
        for (size_t i = 0; i < count; ++i) task(i);
    });
}

Status detail::check_light_sizes(const ProbeVolumeView& volume) {
    const size_t count = volume.positions.size();
    for (const auto& [name, size] : {std::pair("irradiance", volume.irradiance.size()),
                                     std::pair("compact", volume.compact.size())}) {
        if (size == 0 || size == count) continue;
        return Error{ErrorCode::Corrupt, name, "",
                     str_cat("section \"", name, "\": ", size, " elements for ", count, " probes")};
    }
    return Ok{};
}

void detail::store_weights(ProbeVolume& volume, std::span<const float> weights,
                           const RecombinedInfo& info) noexcept {
    for (size_t k = 0; k < weights.size(); ++k) volume.layers[k].weight = weights[k];
    volume.info.ambient = info.ambient;
    if (!volume.compact.empty()) volume.info.compact_scale = info.compact_scale;
}

void detail::recombine_task(ProbeVolume& volume, std::span<const float> weights,
                            size_t task) noexcept {
    const size_t begin = task * kRecombineTaskSize;
    const size_t end = std::min(begin + kRecombineTaskSize, volume.positions.size());
    const auto part = [&](auto& probes) {
        return probes.empty() ? std::span(probes) : std::span(probes).subspan(begin, end - begin);
    };
    recombine_probes(volume.view(), weights, begin, end, part(volume.irradiance),
                     part(volume.compact), volume.info.compact_scale);
}

}  // namespace tetralight
