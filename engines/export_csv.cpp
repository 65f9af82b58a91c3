// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/str_cat.h>
#include <tetralight/engines/detail/probe_light.h>
#include <tetralight/engines/detail/targets.h>
#include <tetralight/engines/escape.h>

namespace tetralight::detail {
namespace {

std::string header() {
    std::string line =
        "x,y,z,group,validity,standard_error,occlusion_0,occlusion_1,occlusion_2,"
        "occlusion_3";
    for (int i = 0; i < kShCoefficientCount; ++i) {
        for (const char channel : {'r', 'g', 'b'}) line += str_cat(",sh", i, '_', channel);
    }
    return line + "\r\n";
}

}  // namespace

Result<ExportedVolume> export_csv(const ProbeVolumeView& volume, const ExportSettings& settings) {
    const auto light = probe_light(volume);
    const auto groups = probe_groups(volume);
    const auto names = split_names(volume.group_names);
    std::string text = header();
    for (uint32_t probe = 0; probe < volume.probe_count(); ++probe) {
        const glm::dvec3 position = world_position(volume, probe);
        const std::string group =
            groups[probe] < names.size() ? escaped_for_csv(names[groups[probe]]) : "";
        const float validity = volume.validity.empty() ? 1.0f : volume.validity[probe];
        text +=
            str_cat(position.x, ',', position.y, ',', position.z, ',', group, ',', validity, ',');
        if (!volume.health.empty()) text += str_cat(volume.health[probe].standard_error);
        const glm::vec4 occlusion =
            volume.occlusion.empty() ? glm::vec4(1.0f) : volume.occlusion[probe];
        for (int i = 0; i < 4; ++i) text += str_cat(',', occlusion[i]);
        for (const glm::vec3& c : light[probe].coefficients) {
            text += str_cat(',', c.r, ',', c.g, ',', c.b);
        }
        text += "\r\n";
    }
    return ExportedVolume{{{settings.name + ".csv", std::move(text)}}, {}, {}};
}

}  // namespace tetralight::detail
