// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/group_files.h>

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

#include <tetralight/bake/scene/probe_groups_json.h>
#include <tetralight/cli/amounts.h>
#include <tetralight/imports/import_groups.h>
#include <tetralight/probes/build/merge.h>

namespace tetralight::cli {

Result<GroupFiles> GroupFiles::read(const std::vector<std::string>& paths,
                                    const SceneReading& reading) {
    GroupFiles files;
    for (const std::string& path : paths) {
        auto imported = import_groups(path, reading);
        if (!imported) return imported.error();
        files.add(path, std::move(imported->groups));
        std::ranges::move(imported->warnings, std::back_inserter(files.warnings_));
    }
    return files;
}

void GroupFiles::add(const std::string& path, std::vector<ProbeGroup> groups) {
    for (ProbeGroup& group : groups) {
        auto& paths = paths_of_group_[group.name];
        if (std::ranges::find(paths, path) == paths.end()) paths.push_back(path);
        groups_.push_back(std::move(group));
    }
}

std::vector<std::string> GroupFiles::locate(std::vector<std::string> warnings) const {
    for (std::string& warning : warnings) {
        const auto group = std::ranges::find_if(paths_of_group_, [&](const auto& named) {
            return warning.starts_with("group \"" + named.first + "\"");
        });
        if (group != paths_of_group_.end()) warning.insert(0, joined(group->second) + ": ");
    }
    return warnings;
}

Error GroupFiles::locate(const Error& error) const {
    const auto index = probe_group_index(error.field);
    if (!index || *index >= groups_.size()) return error;
    return error.in(joined(paths_of_group_.at(groups_[*index].name)));
}

}  // namespace tetralight::cli
