// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/relight.h>

#include <algorithm>
#include <glm/common.hpp>

#include <tetralight/base/str_cat.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/dering.h>
#include <tetralight/probes/is_finite.h>
#include <tetralight/probes/recombine.h>

namespace tetralight {
namespace {

Status check_transfer(const ProbeVolumeView& volume, const char* layer) {
    if (volume.transfer.size() != volume.positions.size() || volume.sky.size() != 1) {
        return Error{
            ErrorCode::InvalidArgument,
            "the volume holds no transfer of distant light (bake it with the layers sky and "
            "transfer)"};
    }
    if (find_layer(volume, layer) != kNoIndex) return Ok{};
    return Error{ErrorCode::NotFound, "layer", layer,
                 str_cat("the volume holds no layer \"", layer, "\" to relight")};
}

/// Fills a layer with `light_of(probe)`, without ringing where that was asked for.
template <class LightOf>
Status fill_layer(ProbeVolume& volume, uint32_t layer, LightOf light_of) {
    const size_t count = volume.positions.size();
    if (volume.layer_irradiance.size() != layer_element_count(volume.layers.size(), count)) {
        return Error{ErrorCode::Corrupt, "layer_irradiance", "",
                     "section \"layer_irradiance\" is missing"};
    }
    const auto light = std::span(volume.layer_irradiance).subspan(layer * count, count);
    for (size_t i = 0; i < count; ++i) {
        light[i] = light_of(volume.transfer[i]);
        const uint8_t window = i < volume.dering.size() ? volume.dering[i] : uint8_t{0};
        if (window > 0) {
            light[i] = dering(light[i], static_cast<DeringWindow>(window - 1));
            light[i].coefficients[0] = glm::max(light[i].coefficients[0], glm::vec3(0.0f));
        }
    }
    if (volume.layer_errors.size() == volume.layer_irradiance.size()) {
        std::ranges::fill(std::span(volume.layer_errors).subspan(layer * count, count), 0.0f);
    }
    volume.layers[layer].largest = largest_coefficient(light);
    return recombine(volume, layer_weights(volume.view()));
}

/// What is far from everything sees all of the sky.
IrradianceSh open_irradiance(const DistantLight& sky) {
    RadianceSh radiance;
    std::copy_n(sky.coefficients.begin(), kShCoefficientCount, radiance.coefficients.begin());
    return irradiance_from_radiance(radiance);
}

}  // namespace

Status relight_sky(ProbeVolume& volume, const DistantLight& sky) {
    if (auto status = check_transfer(volume.view(), "sky"); !status) return status;
    if (!std::ranges::all_of(sky.coefficients, [](const glm::vec3& c) { return is_finite(c); })) {
        return Error{ErrorCode::InvalidArgument, "sky", "", "the sky is not finite"};
    }
    const uint32_t layer = find_layer(volume.view(), "sky");
    volume.sky[0] = sky;
    volume.layers[layer].ambient = open_irradiance(sky);
    return fill_layer(volume, layer,
                      [&](const ProbeTransfer& probe) { return transfer_light(probe, sky); });
}

Result<uint32_t> movable_sun(const ProbeVolumeView& volume) {
    if (auto status = check_transfer(volume, "sun"); !status) return status.error();
    const uint32_t layer = find_layer(volume, "sun");
    uint32_t sun = kNoIndex;
    uint32_t count = 0;
    for (uint32_t i = 0; i < volume.light_states.size() && i < volume.lights.size(); ++i) {
        if (volume.light_states[i].layer != layer) continue;
        sun = i;
        ++count;
    }
    if (count == 1) return sun;
    return Error{ErrorCode::InvalidArgument,
                 str_cat("layer \"sun\" holds ", count, " suns; only one alone can be moved")};
}

Status relight_sun(ProbeVolume& volume, glm::vec3 direction, glm::vec3 irradiance) {
    const auto sun = movable_sun(volume.view());
    if (!sun) return sun.error();
    if (!is_finite(direction) || !is_finite(irradiance))
        return Error{ErrorCode::InvalidArgument, "sun", "", "the sun is not finite"};
    Light& light = volume.lights[*sun];
    light.direction = direction;
    light.intensity = irradiance;
    volume.light_states[*sun].channel = kNoIndex;
    for (OcclusionLights& lights : volume.occlusion_lights) {
        std::ranges::replace(lights, *sun, kNoIndex);
    }
    const bool has_direct = light.mode == LightMode::Baked;
    const DistantLight direct = distant_sun(-direction, irradiance);
    DistantLight bounced = direct;
    bounced *= light.indirect_multiplier;
    return fill_layer(volume, find_layer(volume.view(), "sun"), [&](const ProbeTransfer& probe) {
        IrradianceSh sum = transfer_bounces(probe, bounced);
        if (has_direct) sum += transfer_direct(probe, direct);
        return sum;
    });
}

}  // namespace tetralight
