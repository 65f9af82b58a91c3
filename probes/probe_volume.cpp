// SPDX-License-Identifier: Apache-2.0
#include "probes/probe_volume.h"

namespace tetralight {

ProbeVolumeView ProbeVolume::view() const noexcept {
    return {info,        positions,       irradiance,  occlusion, validity, health,
            compact,     exact_positions, cells,       hull_rays, seeds,    sources,
            group_names, lights,          light_names, metadata};
}

std::vector<std::string_view> split_names(std::string_view names) {
    std::vector<std::string_view> lines;
    while (!names.empty()) {
        const size_t end = names.find('\n');
        lines.push_back(names.substr(0, end));
        names.remove_prefix(end == std::string_view::npos ? names.size() : end + 1);
    }
    return lines;
}

}  // namespace tetralight
