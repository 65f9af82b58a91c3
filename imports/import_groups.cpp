// SPDX-License-Identifier: Apache-2.0
#include <tetralight/imports/import_groups.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>

#include <tetralight/bake/scene/probe_groups_json.h>
#include <tetralight/imports/csv_groups.h>
#include <tetralight/imports/detail/text_file.h>
#include <tetralight/imports/godot_groups.h>
#include <tetralight/imports/unity_groups.h>

namespace tetralight {
namespace {

Result<ImportedGroups> import_json(const std::string& path, const SceneReading&) {
    auto groups = read_probe_groups(path);
    if (!groups) return groups.error();
    return ImportedGroups{std::move(*groups), {}};
}

Result<ImportedGroups> import_gltf(const std::string& path, const SceneReading& reading) {
    auto scene = read_gltf(path, reading);
    if (!scene) return scene.error();
    if (scene->probe_groups.empty()) {
        return Error{ErrorCode::NotFound, "groups", path,
                     path + ": no node has extras.light_probe_group"};
    }
    return ImportedGroups{std::move(scene->probe_groups), {}};
}

template <Result<ImportedGroups> (*read)(const std::string& path)>
Result<ImportedGroups> without_reading(const std::string& path, const SceneReading&) {
    return read(path);
}

struct GroupReader {
    std::string_view extension;
    Result<ImportedGroups> (*read)(const std::string& path, const SceneReading& reading);
};

/// Sorted by their extensions.
constexpr GroupReader kReaders[] = {
    {".csv", without_reading<read_csv_groups>},       //
    {".glb", import_gltf},                            //
    {".gltf", import_gltf},                           //
    {".json", import_json},                           //
    {".prefab", without_reading<read_unity_groups>},  //
    {".tscn", without_reading<read_godot_groups>},    //
    {".unity", without_reading<read_unity_groups>},
};

std::string extension_of(const std::string& path) {
    return detail::in_lower_case(std::filesystem::path(path).extension().string());
}

}  // namespace

Result<ImportedGroups> import_groups(const std::string& path, const SceneReading& reading) {
    const auto reader = std::ranges::find(kReaders, extension_of(path), &GroupReader::extension);
    return reader == std::end(kReaders) ? import_json(path, reading) : reader->read(path, reading);
}

std::vector<std::string> group_file_extensions() {
    std::vector<std::string> extensions;
    for (const GroupReader& reader : kReaders) extensions.emplace_back(reader.extension);
    return extensions;
}

}  // namespace tetralight
