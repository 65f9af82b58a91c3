// SPDX-License-Identifier: Apache-2.0
#include <tetralight/engines/detail/probe_light.h>

#include <tetralight/base/half.h>

namespace tetralight::detail {
namespace {

IrradianceSh expanded(const CompactProbe& probe, float scale) {
    IrradianceSh light;
    for (size_t i = 0; i < probe.irradiance.size(); ++i) {
        const auto channel = static_cast<int>(i % 3);
        light.coefficients[i / 3][channel] = scale * float_from_half(probe.irradiance[i]);
    }
    return light;
}

}  // namespace

std::vector<IrradianceSh> probe_light(const ProbeVolumeView& volume) {
    if (!volume.irradiance.empty()) return {volume.irradiance.begin(), volume.irradiance.end()};
    std::vector<IrradianceSh> light(volume.positions.size(), volume.info.ambient);
    for (size_t i = 0; i < volume.compact.size(); ++i) {
        light[i] = expanded(volume.compact[i], volume.info.compact_scale);
    }
    return light;
}

std::vector<glm::vec4> probe_occlusion(const ProbeVolumeView& volume) {
    std::vector<glm::vec4> occlusion(volume.occlusion.begin(), volume.occlusion.end());
    if (!volume.irradiance.empty() || volume.compact.empty()) return occlusion;
    occlusion.clear();
    for (const CompactProbe& probe : volume.compact) {
        const auto& halves = probe.occlusion;
        occlusion.emplace_back(float_from_half(halves[0]), float_from_half(halves[1]),
                               float_from_half(halves[2]), float_from_half(halves[3]));
    }
    return occlusion;
}

glm::dvec3 world_position(const ProbeVolumeView& volume, uint32_t probe) {
    return volume.info.world_origin + glm::dvec3(volume.positions[probe]);
}

std::vector<uint32_t> probe_groups(const ProbeVolumeView& volume) {
    std::vector<uint32_t> groups(volume.positions.size(), kNoIndex);
    for (const ProbeSource& source : volume.sources) {
        if (source.probe < groups.size() && groups[source.probe] == kNoIndex) {
            groups[source.probe] = source.group;
        }
    }
    return groups;
}

}  // namespace tetralight::detail
