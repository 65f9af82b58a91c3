// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/probe_volume.h>

#include <tetralight/probes/volume_members.h>

namespace tetralight {

ProbeVolumeView ProbeVolume::view() const noexcept {
    ProbeVolumeView view;
    view.info = info;
    for_each_volume_member(
        [&](const char*, MemberUse, auto owner, auto viewed) { view.*viewed = this->*owner; });
    return view;
}

ProbeVolume copy_volume(const ProbeVolumeView& view) {
    ProbeVolume volume;
    volume.info = view.info;
    for_each_volume_member([&](const char*, MemberUse, auto owner, auto viewed) {
        (volume.*owner).assign((view.*viewed).begin(), (view.*viewed).end());
    });
    return volume;
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
