// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/reused_light.h>

#include <algorithm>

#include <tetralight/probes/no_index.h>

namespace tetralight {
namespace {

/// Values of some probes of a volume; nothing if the volume does not have the array.
template <class T>
std::vector<T> gather(std::span<const T> values, std::span<const uint32_t> probes) {
    std::vector<T> gathered;
    if (values.empty()) return gathered;
    for (const uint32_t probe : probes) gathered.push_back(values[probe]);
    return gathered;
}

template <class T>
void scatter(const std::vector<T>& values, std::span<const uint32_t> probes, std::span<T> to) {
    for (size_t i = 0; i < values.size(); ++i) to[probes[i]] = values[i];
}

/// Calls visit(array of `from`, the same array of `to`) for all arrays.
template <class Visit>
void for_each_pair(const ReusedLight& from, ReusedLight& to, Visit visit) {
    visit(from.probes, to.probes);
    visit(from.standard_error, to.standard_error);
    visit(from.validity, to.validity);
    visit(from.irradiance, to.irradiance);
    visit(from.occlusion, to.occlusion);
    visit(from.transfer, to.transfer);
    visit(from.layer_irradiance, to.layer_irradiance);
    visit(from.layer_errors, to.layer_errors);
}

}  // namespace

std::vector<bool> ReusedLight::flags(size_t probe_count) const {
    std::vector<bool> flags(probe_count, false);
    for (const uint32_t probe : probes) flags[probe] = true;
    return flags;
}

void ReusedLight::append(const ReusedLight& other) {
    for_each_pair(other, *this, [](const auto& from, auto& to) {
        to.insert(to.end(), from.begin(), from.end());
    });
}

ReusedLight ReusedLight::in_range(const PlaceRange& range) const {
    std::vector<size_t> kept;
    for (size_t i = 0; i < probes.size(); ++i)
        if (range.contains(probes[i])) kept.push_back(i);
    ReusedLight part;
    for_each_pair(*this, part, [&](const auto& from, auto& to) {
        const size_t each = probes.empty() ? 0 : from.size() / probes.size();
        for (const size_t i : kept) {
            const auto first = from.begin() + static_cast<ptrdiff_t>(i * each);
            to.insert(to.end(), first, first + static_cast<ptrdiff_t>(each));
        }
    });
    return part;
}

ReusedLight reused_light(const ProbeVolumeView& old, std::span<const uint32_t> old_probes) {
    ReusedLight light;
    std::vector<uint32_t> from;
    for (uint32_t i = 0; i < old_probes.size(); ++i) {
        if (old_probes[i] == kNoIndex) continue;
        light.probes.push_back(i);
        from.push_back(old_probes[i]);
    }
    for (const uint32_t probe : from) {
        light.standard_error.push_back(old.health[probe].standard_error);
        for (size_t layer = 0; layer < old.layers.size(); ++layer) {
            const size_t element = layer * old.positions.size() + probe;
            light.layer_irradiance.push_back(old.layer_irradiance[element]);
            light.layer_errors.push_back(old.layer_errors[element]);
        }
    }
    light.validity = gather(old.validity, from);
    light.irradiance = gather(old.irradiance, from);
    light.occlusion = gather(old.occlusion, from);
    light.transfer = gather(old.transfer, from);
    return light;
}

void copy_reused(const ReusedLight& light, ProbeVolume& volume) {
    scatter(light.validity, light.probes, std::span(volume.validity));
    scatter(light.irradiance, light.probes, std::span(volume.irradiance));
    scatter(light.occlusion, light.probes, std::span(volume.occlusion));
    scatter(light.transfer, light.probes, std::span(volume.transfer));
    if (light.probes.empty()) return;
    const size_t layer_count = light.layer_irradiance.size() / light.probes.size();
    const size_t probe_count = volume.positions.size();
    for (size_t i = 0; i < light.layer_irradiance.size(); ++i) {
        const size_t layer = i % layer_count;
        const size_t element = layer * probe_count + light.probes[i / layer_count];
        volume.layer_irradiance[element] = light.layer_irradiance[i];
        volume.layer_errors[element] = light.layer_errors[i];
    }
}

void copy_reused(const ReusedLight& light, BakedProbes& baked) {
    scatter(light.standard_error, light.probes, std::span(baked.standard_error));
}

}  // namespace tetralight
