// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/detail/verify_layers.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include <tetralight/base/str_cat.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/dering.h>
#include <tetralight/probes/is_finite.h>
#include <tetralight/probes/layer.h>
#include <tetralight/probes/section_error.h>
#include <tetralight/probes/section_text.h>

namespace tetralight::detail {
namespace {

Status check_count(std::string_view section, size_t count, uint64_t expected) {
    if (count == 0 || count == expected) return Ok{};
    return section_error(section, str_cat(count, " elements instead of ", expected));
}

/// Checks sections whose elements consist of floats, of at most this magnitude.
template <class T>
Status check_floats(std::string_view section, std::span<const T> elements, float largest) {
    static_assert(sizeof(T) % sizeof(float) == 0);
    const auto* floats = reinterpret_cast<const float*>(elements.data());
    const size_t each = sizeof(T) / sizeof(float);
    for (size_t i = 0; i < elements.size() * each; ++i) {
        if (std::abs(floats[i]) <= largest) continue;
        return element_error(section, i / each, str_cat("is not finite, or above ", largest));
    }
    return Ok{};
}

template <class T, class Predicate>
Status check_each(std::string_view section, std::span<const T> elements, Predicate is_good) {
    for (size_t i = 0; i < elements.size(); ++i) {
        if (is_good(elements[i])) continue;
        return element_error(section, i, "is out of range");
    }
    return Ok{};
}

// The products of both, which relighting adds, are finite. The sky of 1e30, the brightest that can
// be baked, has coefficients of at most 1.3e31.
constexpr float kLargestTransfer = 1e6f;
constexpr float kLargestSky = 2e31f;

bool is_index(uint32_t index, size_t count) {
    return index < count || index == kNoIndex;
}

bool is_in_range(const Layer& layer) {
    const float ambient = largest_coefficient(std::span(&layer.ambient, 1));
    return std::isfinite(layer.weight) && layer.weight >= 0.0f && layer.largest >= 0.0f &&
           layer.largest <= kLargestCoefficient && is_finite(layer.ambient) &&
           ambient <= kLargestCoefficient;
}

Status check_counts(const ProbeVolumeView& v) {
    const size_t probes = v.positions.size();
    const size_t names = split_names(v.layer_names).size();
    if (names != v.layers.size()) {
        return section_error("layer_names",
                             str_cat(names, " names for ", v.layers.size(), " layers"));
    }
    const uint64_t expected = layer_element_count(v.layers.size(), probes);
    for (const Status& status :
         {check_count("light_states", v.light_states.size(), v.lights.size()),
          check_count("occlusion_lights", v.occlusion_lights.size(), probes),
          check_count("layer_irradiance", v.layer_irradiance.size(), expected),
          check_count("layer_errors", v.layer_errors.size(), expected),
          check_count("transfer", v.transfer.size(), probes), check_count("sky", v.sky.size(), 1),
          check_count("dering", v.dering.size(), probes)}) {
        if (!status) return status;
    }
    return Ok{};
}

/// The bound of each layer holds: combinations of layers are finite because of it.
Status check_bounds(const ProbeVolumeView& v) {
    const size_t probes = v.positions.size();
    for (size_t k = 0; k < v.layers.size() && !v.layer_irradiance.empty(); ++k) {
        const float largest = largest_coefficient(v.layer_irradiance.subspan(k * probes, probes));
        if (largest <= v.layers[k].largest) continue;
        return element_error("layers", k,
                             str_cat("has coefficients up to ", largest, ", but its bound is ",
                                     v.layers[k].largest));
    }
    return Ok{};
}

}  // namespace

Status check_layers(const ProbeVolumeView& v) {
    if (auto status = check_counts(v); !status) return status;
    const auto is_state = [&](const LightState& state) {
        return state.mixed_lighting <= MixedLighting::Subtractive &&
               (state.channel < 4 || state.channel == kNoIndex) &&
               is_index(state.layer, v.layers.size()) && state.fell_back <= 1;
    };
    const auto are_lights = [&](const OcclusionLights& lights) {
        return std::ranges::all_of(
            lights, [&](uint32_t light) { return is_index(light, v.lights.size()); });
    };
    const auto is_error = [](float error) { return error >= 0.0f && std::isfinite(error); };
    const auto is_window = [](uint8_t window) {
        return window <= 1 + static_cast<uint8_t>(DeringWindow::Lanczos);
    };
    for (const Status& status :
         {check_distinct_names("layer_names", v.layer_names),
          check_each("light_states", v.light_states, is_state),
          check_each("occlusion_lights", v.occlusion_lights, are_lights),
          check_each("layers", v.layers, is_in_range),
          check_floats("layer_irradiance", v.layer_irradiance, kLargestCoefficient),
          check_each("layer_errors", v.layer_errors, is_error),
          check_floats("transfer", v.transfer, kLargestTransfer),
          check_floats("sky", v.sky, kLargestSky), check_each("dering", v.dering, is_window)}) {
        if (!status) return status;
    }
    return check_bounds(v);
}

}  // namespace tetralight::detail
