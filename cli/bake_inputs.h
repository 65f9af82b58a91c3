// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/cli/group_files.h>
#include <tetralight/cli/scene_options.h>
#include <tetralight/pipeline/bake_volume.h>

namespace tetralight::cli {

/// What a bake of probes reads: the scene, probe groups and settings, from the settings of `bake`.
struct BakeInputs {
    SceneOptions scene_options;
    std::vector<std::string> group_paths;
    bool only_given_groups = false;
    std::string prepared_path;  ///< empty: probes and cells are made of the groups
    BakeVolumeSettings settings;

    /// Throws a `UsageError` if settings do not go together.
    explicit BakeInputs(const Values& values);

    /// The files that are read.
    [[nodiscard]] std::vector<std::string> paths() const;

    /// Reads the probes and cells, or makes them of the groups, which are taken out of the scene.
    /// `files` receives the groups. Errors name their file.
    [[nodiscard]] Result<PreparedBake> prepare(Scene& scene, GroupFiles& files) const;

  private:
    [[nodiscard]] Result<GroupFiles> all_groups(Scene& scene) const;
};

}  // namespace tetralight::cli
