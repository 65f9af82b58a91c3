// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/base/result.h>
#include <tetralight/probes/probe_group.h>

namespace tetralight::cli {

/// Probe groups, and the files that they came from.
class GroupFiles {
  public:
    /// Reads every file with the reader of its extension (`import_groups`). Returns an error if a
    /// file other than JSON has no group.
    [[nodiscard]] static Result<GroupFiles> read(const std::vector<std::string>& paths,
                                                 const SceneReading& reading = {});

    /// Adds the groups of one file.
    void add(const std::string& path, std::vector<ProbeGroup> groups);

    [[nodiscard]] const std::vector<ProbeGroup>& groups() const { return groups_; }

    /// What the files have and is not read.
    [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

    /// Warnings with the file, or the files, of the group that they begin with before them.
    [[nodiscard]] std::vector<std::string> locate(std::vector<std::string> warnings) const;

    /// Puts the file, or the files, of the group that an error is about (its field) before it.
    [[nodiscard]] Error locate(const Error& error) const;

  private:
    std::vector<ProbeGroup> groups_;
    std::vector<std::string> warnings_;
    std::map<std::string, std::vector<std::string>> paths_of_group_;
};

}  // namespace tetralight::cli
