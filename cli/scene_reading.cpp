// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/scene_reading.h>

#include <tetralight/bake/scene/length_unit.h>
#include <tetralight/bake/scene/probe_groups_json.h>
#include <tetralight/base/file.h>

namespace tetralight::cli {
namespace {

bool has_asset(std::string_view text) {
    using settings::Json;
    if (const size_t first = text.find_first_not_of(" \t\r\n");
        first == text.npos || text[first] != '{') {
        return false;
    }
    bool is_found = false;
    // Keeps nothing but the outermost object, whatever the size of the file.
    const auto look = [&](int depth, Json::parse_event_t event, const Json& parsed) {
        if (depth == 1 && event == Json::parse_event_t::key && parsed == "asset") is_found = true;
        return depth == 0;
    };
    const Json parsed = Json::parse(text, look, false);
    return is_found && !parsed.is_discarded();
}

}  // namespace

SceneReading scene_reading(const Values& values, NormalMaps normal_maps) {
    SceneReading reading;
    reading.normal_maps = normal_maps;
    if (has_setting(values, "scene_name")) reading.scene = values.text("scene_name");
    if (values.is_given("time")) reading.time = values.number("time");
    reading.animation = values.text("animation");
    if (has_setting(values, "light_unit"))
        reading.light_unit = choice<LightUnit>(values, "light_unit");
    reading.has_other_sky = has_setting(values, "sky") && values.is_given("sky");
    return reading;
}

Status check_no_scene_reading(const Values& values, std::string_view message) {
    for (const char* name : {"scene_name", "time", "animation", "light_unit"}) {
        if (has_setting(values, name) && values.is_given(name)) return values.error(name, message);
    }
    return Ok{};
}

Result<Scene> read_scene(const std::string& path, const SceneReading& reading) {
    auto scene = read_gltf(path, reading);
    // A file of groups is a glTF file without a version.
    const bool may_be_groups = !scene && scene.error().field == "asset.version";
    if (may_be_groups && read_probe_groups(path))
        return Error{ErrorCode::InvalidArgument, "scene", path,
                     path + ": contains probe groups, not a scene"};
    if (scene || scene.error().field != "scene" || reading.scene.empty()) return scene;
    Error error = scene.error();
    error.field = "scene_name";
    return error;
}

std::vector<std::string> in_file(const std::string& path, std::vector<std::string> warnings) {
    for (std::string& warning : warnings) warning.insert(0, path + ": ");
    return warnings;
}

Error with_size_hint(const Error& error, const Scene& scene) {
    const bool is_about_size = error.field == "max_probes" || error.field == "texels_per_meter" ||
                               error.code == ErrorCode::OutOfResources;
    const std::string hint = is_about_size ? length_unit_hint(scene) : "";
    if (hint.empty()) return error;
    Error hinted = error;
    hinted.message = error.message.suffixed("; " + hint);
    return hinted;
}

bool is_scene_file(const std::string& path) {
    const auto file = MappedFile::open(path);
    if (!file) return false;
    const std::string_view text(reinterpret_cast<const char*>(file->bytes().data()),
                                file->bytes().size());
    return text.starts_with("glTF") || has_asset(text);
}

}  // namespace tetralight::cli
