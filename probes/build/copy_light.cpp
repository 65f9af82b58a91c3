// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/copy_light.h>

#include <span>

#include <tetralight/base/contract.h>
#include <tetralight/probes/build/detail/position_table.h>
#include <tetralight/probes/build/store_visibility.h>
#include <tetralight/probes/rendering_layers.h>

namespace tetralight {
namespace {

constexpr OcclusionLights kNoLights{kNoIndex, kNoIndex, kNoIndex, kNoIndex};

/// One value a probe: that of its twin, or `unlit`. Empty stays empty.
template <class T>
std::vector<T> copy_from_twins(std::span<const T> values, std::span<const uint32_t> twins,
                               const T& unlit) {
    std::vector<T> copied;
    if (values.empty()) return copied;
    copied.reserve(twins.size());
    for (const uint32_t twin : twins) copied.push_back(twin == kNoIndex ? unlit : values[twin]);
    return copied;
}

}  // namespace

CopiedLight copy_light(const ProbeVolumeView& from, ProbeVolume& to) {
    TETRALIGHT_ASSERT(from.exact_positions.size() == from.positions.size(),
                      "copy_light from a volume without exact positions");
    TETRALIGHT_ASSERT(to.exact_positions.size() == to.positions.size(),
                      "copy_light to a volume without exact positions");
    const detail::PositionTable table(from.exact_positions);
    CopiedLight result;
    std::vector<uint32_t> twins;
    for (uint32_t i = 0; i < to.exact_positions.size(); ++i) {
        twins.push_back(from.irradiance.empty() ? kNoIndex : table.find(to.exact_positions[i]));
        if (twins.back() == kNoIndex) result.unlit.push_back(i);
    }
    result.copied_count = static_cast<uint32_t>(twins.size() - result.unlit.size());
    to.irradiance = copy_from_twins(from.irradiance, twins, IrradianceSh());
    to.occlusion = copy_from_twins(from.occlusion, twins, glm::vec4(1.0f));
    to.validity = copy_from_twins(from.validity, twins, 0.0f);
    to.health = copy_from_twins(from.health, twins, ProbeHealth());
    to.info.ambient = from.info.ambient;
    to.lights.assign(from.lights.begin(), from.lights.end());
    to.light_names = from.light_names;
    to.light_states.assign(from.light_states.begin(), from.light_states.end());
    to.occlusion_lights = copy_from_twins(from.occlusion_lights, twins, kNoLights);
    to.transfer = copy_from_twins(from.transfer, twins, ProbeTransfer());
    to.sky.assign(from.sky.begin(), from.sky.end());
    to.dering = copy_from_twins(from.dering, twins, uint8_t{0});
    copy_visibility(from, to);
    if (to.rendering_layers.empty()) {
        to.rendering_layers = copy_from_twins(from.rendering_layers, twins, kAllRenderingLayers);
    }
    to.layers.assign(from.layers.begin(), from.layers.end());
    to.layer_names = from.layer_names;
    to.layer_irradiance.clear();
    for (size_t begin = 0; begin < from.layer_irradiance.size(); begin += from.positions.size()) {
        const auto layer = from.layer_irradiance.subspan(begin, from.positions.size());
        const auto copied = copy_from_twins(layer, twins, IrradianceSh());
        to.layer_irradiance.insert(to.layer_irradiance.end(), copied.begin(), copied.end());
    }
    to.layer_errors.clear();
    for (size_t begin = 0; begin < from.layer_errors.size(); begin += from.positions.size()) {
        const auto layer = from.layer_errors.subspan(begin, from.positions.size());
        const auto copied = copy_from_twins(layer, twins, 0.0f);
        to.layer_errors.insert(to.layer_errors.end(), copied.begin(), copied.end());
    }
    return result;
}

}  // namespace tetralight
