// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <tetralight/bake/image/write_image.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/export_reflections.h>
#include <tetralight/cli/export_volume.h>
#include <tetralight/cli/lightmap_files.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/reflection_files.h>
#include <tetralight/cli/scene_reading.h>
#include <tetralight/pipeline/exported_texels.h>
#include <tetralight/pipeline/lightmap_images.h>
#include <tetralight/pipeline/write_lightmap_glb.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/render/page_preview.h>

namespace tetralight::cli {
namespace {

/// In the order of the choices of `as`.
enum class ExportFormat : uint8_t { Exr, Ktx2, Png, Glb, Preview };

std::optional<ExportFormat> format_of(const std::string& output) {
    const std::pair<const char*, ExportFormat> extensions[] = {{".exr", ExportFormat::Exr},
                                                               {".ktx2", ExportFormat::Ktx2},
                                                               {".png", ExportFormat::Png},
                                                               {".glb", ExportFormat::Glb}};
    for (const auto& [extension, format] : extensions) {
        if (output.ends_with(extension)) return format;
    }
    return std::nullopt;
}

ExportFormat chosen_format(const Values& values) {
    const std::string output = values.text("output");
    const auto named = format_of(output);
    if (!named && !values.is_given("as")) require(values, "as");
    if (!values.is_given("as")) return *named;
    const auto chosen = choice<ExportFormat>(values, "as");
    const auto written = chosen == ExportFormat::Preview ? ExportFormat::Png : chosen;
    if (named && *named != written) {
        refuse(values, "as",
               str_cat(values.text("as"), " does not fit the name of the output, ", output));
    }
    return chosen;
}

struct Export {
    std::string lightmaps_path;
    std::string output;
    std::string scene_path;
    SceneReading reading;
    /// What is wrong if the file contains reflection probes.
    Status with_reflections;
    ExportFormat format;
    LightmapMap map;
    std::vector<std::string> packed;
    std::vector<std::string> marked;
    std::vector<std::string> probe_names;
    uint32_t level = 0;
    bool has_lightmap_settings = false;
    bool has_cube_settings = false;
    CommonOptions common;

    explicit Export(const Values& values)
        : lightmaps_path(values.text("volume")),
          output(values.text("output")),
          scene_path(values.text("scene")),
          reading(scene_reading(values)),
          with_reflections(check_no_scene_reading(values, "is for lightmaps")),
          format(chosen_format(values)),
          map(choice<LightmapMap>(values, "map")),
          packed(values.texts("pack")),
          marked(values.texts("mark")),
          probe_names(values.texts("probe")),
          level(static_cast<uint32_t>(values.integer("level"))),
          has_lightmap_settings(values.is_given("map") || !packed.empty() || !marked.empty()),
          has_cube_settings(!probe_names.empty() || values.is_given("level")),
          common(values) {
        if (format == ExportFormat::Glb && scene_path.empty()) require(values, "scene");
        if (format != ExportFormat::Glb && !scene_path.empty())
            refuse(values, "scene", "only glb has a scene");
        if (format == ExportFormat::Glb && map != LightmapMap::Irradiance)
            refuse(values, "map", "a glb has irradiance only");
        if (format == ExportFormat::Glb && !packed.empty())
            refuse(values, "pack", "a glb has irradiance only");
        if (format == ExportFormat::Glb && values.is_given("level"))
            refuse(values, "level", "a glb has all levels");
        if (format == ExportFormat::Glb && probe_names.size() > 1)
            refuse(values, "probe", "a glb has one image-based light");
        if (!packed.empty() && values.is_given("map"))
            refuse(values, "pack", "is given beside " + values.shown("map"));
        for (const char* name : {"bounds", "resolution", "spacing", "at"}) {
            if (values.is_given(name)) refuse(values, name, "is for probe volumes");
        }
        if (format != ExportFormat::Preview && !marked.empty())
            refuse(values, "mark", "only previews mark objects");
    }

    Status run() const {
        if (is_reflection_file(lightmaps_path)) return run_reflections();
        if (has_cube_settings) {
            return Error{ErrorCode::InvalidArgument, probe_names.empty() ? "level" : "probe", "",
                         "--probe and --level are for reflection probes, and " +
                             shown_path(lightmaps_path) + " has none"};
        }
        const auto file = open_lightmaps(lightmaps_path);
        if (!file) return file.error();
        const LightmapsView& maps = (*file)->view();
        const auto paths = output_paths(maps.info.page_count);
        if (!paths) return paths.error();
        Json json{{"output", output}, {"files", *paths}, {"pages", maps.info.page_count}};
        if (auto status = write(maps, json); !status) return status;
        const std::string files =
            paths->size() == 1 ? "" : str_cat(" (", counted(paths->size(), "file"), ")");
        common.report(output, json,
                      str_cat(paths->front(), files, ": ", counted(maps.info.page_count, "page"),
                              " of ", maps.info.page_size, " x ", maps.info.page_size, note(json)));
        return Ok{};
    }

    [[nodiscard]] Status run_reflections() const {
        const std::string start = shown_path(lightmaps_path) + ": contains reflection probes";
        if (has_lightmap_settings) {
            return Error{ErrorCode::InvalidArgument, "volume", lightmaps_path,
                         start + "; --map, --pack and --mark are for lightmaps"};
        }
        if (!with_reflections) return with_reflections;
        const ReflectionExport what{lightmaps_path, output, probe_names, scene_path, level};
        if (format == ExportFormat::Glb) return export_reflection_scene(what, common);
        if (format == ExportFormat::Exr) return export_reflection_images(what, common);
        return Error{ErrorCode::InvalidArgument, "as", "",
                     start + ", which are written as exr or glb"};
    }

    /// The files that are written, checked.
    [[nodiscard]] Result<std::vector<std::string>> output_paths(uint32_t page_count) const {
        const bool has_file_a_page = format != ExportFormat::Ktx2 && format != ExportFormat::Glb;
        const uint32_t count = has_file_a_page ? page_count : std::min(page_count, 1u);
        if (output == "-" && count > 1) {
            return Error{ErrorCode::InvalidArgument, "output", output,
                         str_cat("-: cannot write ", count, " pages to stdout")};
        }
        std::vector<std::string> paths;
        for (uint32_t page = 0; page < count; ++page) {
            paths.push_back(page_path(output, page, count));
            auto status = check_output(paths.back(), {lightmaps_path, scene_path});
            if (!status) return status.error();
        }
        if (!paths.empty()) return paths;
        return Error{ErrorCode::InvalidArgument, "volume", lightmaps_path,
                     lightmaps_path + ": has no pages"};
    }

    [[nodiscard]] Status write(const LightmapsView& maps, Json& json) const {
        if (format == ExportFormat::Glb) return write_scene(maps);
        const auto values = packed.empty() ? map_values(maps, map) : packed_values(maps, packed);
        if (!values) return values.error().in(shown_path(lightmaps_path));
        if (format == ExportFormat::Exr) return write_exr_pages(output, *values);
        if (format == ExportFormat::Preview) return write_preview(maps, *values);
        const bool is_png = format == ExportFormat::Png;
        const auto factor =
            is_png ? write_png_pages(output, *values) : write_ktx2_pages(output, *values);
        if (!factor) return factor.error();
        if (!values->is_fraction) json[is_png ? "range" : "scale"] = *factor;
        return Ok{};
    }

    [[nodiscard]] Status write_preview(const LightmapsView& maps,
                                       const ExportedTexels& values) const {
        for (const std::string& name : marked) {
            if (std::ranges::count(instances_named(maps, {name}), true) > 0) continue;
            return Error{ErrorCode::NotFound, "mark", name,
                         str_cat(shown_path(lightmaps_path), ": no object \"", name,
                                 "\" has a lightmap there")};
        }
        const std::vector<bool> is_marked = instances_named(maps, marked);
        for (uint32_t page = 0; page < maps.info.page_count; ++page) {
            const Image8 image = page_preview(maps, values, page, is_marked);
            auto status = write_png(page_path(output, page, maps.info.page_count), image);
            if (!status) return status;
        }
        return Ok{};
    }

    [[nodiscard]] Status write_scene(const LightmapsView& maps) const {
        const auto scene = read_scene(scene_path, reading);
        if (!scene) return scene.error();
        common.warn(scene->warnings);
        const auto status = write_lightmap_glb(output, scene_path, *scene, maps, reading);
        if (status || status.error().field != "scene") return status;
        Error error = status.error().in(scene_path);
        error.value = scene_path;
        return error;
    }

    [[nodiscard]] std::string note(const Json& json) const {
        const char* value = packed.empty() ? ", irradiance = " : ", value = ";
        if (json.contains("range"))
            return str_cat(value, json["range"].get<float>(), " x alpha x rgb");
        if (json.contains("scale") && json["scale"] != 1.0f)
            return str_cat(value, json["scale"].get<float>(), " x rgb");
        return "";
    }
};

}  // namespace

Status run_export(const Values& values) {
    // Lightmaps and reflection probes have extensions of some targets, too: those need --as.
    const bool is_image = !values.is_given("as") && format_of(values.text("output"));
    const ExportTarget* target = is_image ? nullptr : chosen_export_target(values);
    if (target != nullptr) return export_volume(values, *target);
    const std::string path = values.text("volume");
    if (open_probe_file_lazy(path)) {
        return Error{
            ErrorCode::InvalidArgument, "as", "",
            shown_path(path) + ": contains probes; --as names a format for them (docs/engines.md)"};
    }
    return Export(values).run();
}

}  // namespace tetralight::cli
