// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/dering_probes.h>

#include <tetralight/base/contract.h>

namespace tetralight {

const char* name_of(DeringWindow window) {
    constexpr const char* kNames[] = {"mildest", "hann", "lanczos"};
    return kNames[static_cast<size_t>(window)];
}

std::vector<bool> dering_asked_for(const MergedProbes& merged, const DeringSettings& settings) {
    std::vector<bool> is_asked_for(merged.positions.size(), settings.is_for_all_groups);
    for (const ProbeSource& source : merged.sources) {
        if (source.probe == kNoIndex) continue;
        if (merged.group_dering[source.group]) is_asked_for[source.probe] = true;
    }
    return is_asked_for;
}

std::vector<uint8_t> dering_marks(const MergedProbes& merged, const DeringSettings& settings) {
    const auto mark = static_cast<uint8_t>(1 + static_cast<uint8_t>(settings.window));
    std::vector<uint8_t> marks;
    for (const bool is_asked_for : dering_asked_for(merged, settings)) {
        marks.push_back(is_asked_for ? mark : uint8_t{0});
    }
    return marks;
}

size_t dering_probes(const MergedProbes& merged, const DeringSettings& settings,
                     std::span<IrradianceSh> irradiance) {
    TETRALIGHT_ASSERT(irradiance.size() == merged.positions.size(), "one irradiance a probe");
    const std::vector<bool> is_asked_for = dering_asked_for(merged, settings);
    size_t count = 0;
    for (size_t i = 0; i < irradiance.size(); ++i) {
        if (!is_asked_for[i]) continue;
        irradiance[i] = dering(irradiance[i], settings.window);
        ++count;
    }
    return count;
}

}  // namespace tetralight
