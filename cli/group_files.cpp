// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/group_files.h>

#include <algorithm>
#include <filesystem>
#include <span>

#include <tetralight/bake/scene/probe_groups_json.h>
#include <tetralight/cli/amounts.h>
#include <tetralight/probes/build/merge.h>

namespace tetralight::cli {
namespace {

bool is_gltf(const std::string& path) {
    const auto extension = std::filesystem::path(path).extension();
    return extension == ".glb" || extension == ".gltf";
}

Result<std::vector<ProbeGroup>> read_groups(const std::string& path, const SceneReading& reading) {
    if (!is_gltf(path)) return read_probe_groups(path);
    auto scene = read_gltf(path, reading);
    if (!scene) return scene.error();
    if (scene->probe_groups.empty()) {
        return Error{ErrorCode::NotFound, "groups", path,
                     path + ": no node has extras.light_probe_group"};
    }
    return std::move(scene->probe_groups);
}

}  // namespace

Result<GroupFiles> GroupFiles::read(const std::vector<std::string>& paths,
                                    const SceneReading& reading) {
    GroupFiles files;
    for (const std::string& path : paths) {
        auto groups = read_groups(path, reading);
        if (!groups) return groups.error();
        files.add(path, std::move(*groups));
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
