// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/bake_inputs.h>

#include <utility>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/bake_settings.h>
#include <tetralight/pipeline/partial_bake.h>

namespace tetralight::cli {

BakeInputs::BakeInputs(const Values& values)
    : scene_options(values),
      group_paths(values.texts("groups")),
      only_given_groups(values.flag("only_given_groups")),
      prepared_path(values.text("prepared")),
      settings(bake_settings(values)) {}

std::vector<std::string> BakeInputs::paths() const {
    std::vector<std::string> paths = scene_options.inputs();
    paths.insert(paths.end(), group_paths.begin(), group_paths.end());
    if (!prepared_path.empty()) paths.push_back(prepared_path);
    return paths;
}

Result<PreparedBake> BakeInputs::prepare(Scene& scene, GroupFiles& files) const {
    if (!prepared_path.empty()) return read_prepared_bake(prepared_path, scene, settings);
    auto groups = all_groups(scene);
    if (!groups) return groups.error();
    files = std::move(*groups);
    auto prepared = prepare_bake(scene, files.groups(), settings);
    if (prepared) return prepared;
    const Error& error = prepared.error();
    return error.field.starts_with("lights[") ? error.in(scene_options.path) : files.locate(error);
}

Result<GroupFiles> BakeInputs::all_groups(Scene& scene) const {
    auto files = GroupFiles::read(group_paths);
    if (!files || only_given_groups) return files;
    files->add(scene_options.path, std::move(scene.probe_groups));
    if (files->groups().empty()) {
        return Error{ErrorCode::NotFound, "groups", "",
                     scene_options.path +
                         ": the scene has no probe groups; give some with --groups, made by "
                         "`tetralight grid` for example"};
    }
    return files;
}

}  // namespace tetralight::cli
