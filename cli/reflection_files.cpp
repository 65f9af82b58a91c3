// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/reflection_files.h>

#include <cstring>

#include <tetralight/base/file.h>
#include <tetralight/base/json/check_metadata.h>
#include <tetralight/base/ktx2.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/amounts.h>
#include <tetralight/cli/failure.h>
#include <tetralight/cli/table.h>
#include <tetralight/reflection/reflection_file.h>
#include <tetralight/reflection/relight_reflections.h>

namespace tetralight::cli {
namespace {

std::string coordinates(const glm::dvec3& v) {
    return str_cat(v.x, ", ", v.y, ", ", v.z);
}

Json box_json(const ReflectionProbe& probe) {
    if (probe.is_everywhere()) return {};
    Json axes = Json::array();
    for (const glm::vec3& axis : probe.axes) axes.push_back(to_json(axis));
    return {{"center", to_json(probe.box_center)},
            {"half_size", to_json(probe.half_size)},
            {"axes", axes}};
}

Json listed_probes(const ReflectionFile& file) {
    const auto names = file.names();
    Json probes = Json::array();
    for (size_t i = 0; i < file.view().probes.size(); ++i) {
        const ReflectionProbe& probe = file.view().probes[i];
        probes.push_back({{"name", i < names.size() ? Json(names[i]) : Json()},
                          {"position", to_json(probe.position)},
                          {"box", box_json(probe)},
                          {"blend_distance", probe.blend_distance},
                          {"importance", probe.importance},
                          {"validity", probe.validity}});
    }
    return probes;
}

Json layers_json(const ReflectionsView& all) {
    const auto names = split_names(all.layer_names);
    Json layers = Json::array();
    for (size_t k = 0; k < all.layers.size(); ++k)
        layers.push_back({{"name", names[k]}, {"weight", all.layers[k].weight}});
    return layers;
}

Json reflections_json(const std::string& path, const ReflectionFile& file) {
    const ReflectionsView& all = file.view();
    Json roughness = Json::array();
    for (uint32_t level = 0; level < all.level_count; ++level)
        roughness.push_back(roughness_of_level(level, all.level_count));
    return {{"file", path},
            {"cube_size", all.size},
            {"levels", all.level_count},
            {"roughness", roughness},
            {"probes", listed_probes(file)},
            {"layers", layers_json(all)},
            {"made_with", all.metadata.empty() ? Json() : Json::parse(all.metadata)}};
}

std::string cubes_text(const ReflectionsView& all) {
    const auto names = split_names(all.layer_names);
    std::string layers;
    for (size_t k = 0; k < all.layers.size(); ++k) {
        layers += str_cat(k == 0 ? ", layers " : ", ", printable(std::string(names[k])), " ",
                          all.layers[k].weight);
    }
    return str_cat(counted(all.probes.size(), "reflection probe"), " of ", all.size, " x ",
                   all.size, ", ", counted(all.level_count, "level"), layers);
}

/// The file, with its metadata checked.
Result<ReflectionFile> open_with_metadata(const std::string& path) {
    auto file = open_reflection_file(path);
    if (!file) return file;
    if (auto status = check_metadata(file->view().metadata); !status) {
        return status.error().in(shown_path(path));
    }
    return file;
}

}  // namespace

bool is_reflection_file(const std::string& path) {
    const auto file = MappedFile::open(path);
    if (!file || file->bytes().size() < kKtx2Identifier.size()) return false;
    return std::memcmp(file->bytes().data(), kKtx2Identifier.data(), kKtx2Identifier.size()) == 0;
}

std::string reflection_table(std::span<const ReflectionProbe> probes,
                             std::span<const std::string_view> names) {
    std::vector<std::vector<std::string>> rows{
        {"probe", "position", "size of the box", "validity"}};
    for (size_t i = 0; i < probes.size(); ++i) {
        const ReflectionProbe& probe = probes[i];
        const bool is_everywhere = probe.is_everywhere();
        const std::string name = i < names.size() ? printable(std::string(names[i])) : str_cat(i);
        rows.push_back({name, is_everywhere ? "-" : coordinates(probe.position),
                        is_everywhere ? "everywhere" : coordinates(2.0f * probe.half_size),
                        percent(probe.validity)});
    }
    std::string lines = aligned(rows, "lllr");
    if (!lines.empty()) lines.pop_back();
    return lines;
}

Status show_reflections(const std::string& path, const CommonOptions& common) {
    const auto file = open_with_metadata(path);
    if (!file) return file.error();
    const ReflectionsView& all = file->view();
    std::string text = str_cat(printable(path), ": ", cubes_text(all), "\n",
                               reflection_table(all.probes, file->names()));
    if (!all.metadata.empty()) text += "\nmade with " + printable(std::string(all.metadata));
    common.print(reflections_json(path, *file), text);
    return Ok{};
}

Status relight_reflection_file(const std::string& path, const std::string& output,
                               const std::vector<std::pair<std::string, float>>& weights,
                               const CommonOptions& common) {
    const auto file = open_with_metadata(path);
    if (!file) return file.error();
    Reflections reflections = file->copy();
    std::vector<LayerWeight> changes;
    for (const auto& [layer, weight] : weights) changes.push_back({layer, weight});
    const auto clamped = relight_reflections(reflections, changes);
    if (!clamped) return clamped.error().in(shown_path(path));
    if (*clamped > 0.0) {
        common.warn({str_cat(shown_path(output), ": ", percent(*clamped),
                             " of the light is brighter than a half can be, and was clamped")});
    }
    if (auto status = write_reflection_file(output, reflections); !status) return status;
    const ReflectionsView all = reflections.view();
    common.report(output,
                  {{"output", output}, {"layers", layers_json(all)}, {"clamped_share", *clamped}},
                  str_cat(output, ": ", cubes_text(all)));
    return Ok{};
}

Status validate_reflections(const std::string& path, const CommonOptions& common) {
    const auto file = open_with_metadata(path);
    if (!file && can_retry(file.error().code)) return file.error();
    if (!file) {
        const std::string problem = error_json(file.error())["message"];
        return with_report(
            file.error(),
            {{"file", path}, {"is_valid", false}, {"problems", std::vector<std::string>{problem}}});
    }
    Json json = reflections_json(path, *file);
    json["is_valid"] = true;
    json["problems"] = Json::array();
    common.print(json, str_cat(printable(path), ": valid, ", cubes_text(file->view())));
    return Ok{};
}

}  // namespace tetralight::cli
