// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/export_volume.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <span>

#include <tetralight/base/file.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/lightmap_files.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/reflection_files.h>
#include <tetralight/pipeline/partial_bake.h>
#include <tetralight/probes/probe_file.h>

namespace tetralight::cli {
namespace {

namespace fs = std::filesystem;

/// Settings that are about lightmaps and reflection probes.
constexpr const char* kOtherSettings[] = {"map",       "pack",      "scene",      "mark",
                                          "probe",     "level",     "scene_name", "time",
                                          "animation", "light_unit"};

void check_settings(const Values& values, const ExportTarget& target) {
    for (const char* name : kOtherSettings) {
        if (values.is_given(name)) refuse(values, name, "is for lightmaps and reflection probes");
    }
    for (const char* name : {"bounds", "resolution", "spacing"}) {
        if (!target.has_grid && values.is_given(name)) {
            refuse(values, name, str_cat("is for grids, and ", target.name, " is not a grid"));
        }
    }
    if (!target.has_places && values.is_given("at")) {
        refuse(values, "at", str_cat(target.name, " does not hold the light of single places"));
    }
    const std::string output = values.text("output");
    if (output != "-" && !output.ends_with(target.extension)) {
        refuse(values, "output",
               str_cat(output, ": a file for ", target.name, " ends with ", target.extension));
    }
}

/// Precondition: the output is "-" or ends with the extension of the target.
ExportSettings export_settings(const Values& values, const ExportTarget& target) {
    ExportSettings settings;
    const std::string file = fs::path(values.text("output")).filename().string();
    const size_t name_size = file.size() - std::string_view(target.extension).size();
    if (file != "-" && name_size > 0) settings.name = file.substr(0, name_size);
    if (values.is_given("bounds")) {
        const auto b = values.numbers("bounds");
        settings.bounds = Box<glm::dvec3>{{b[0], b[1], b[2]}, {b[3], b[4], b[5]}};
    }
    if (values.is_given("resolution")) {
        const auto cells = values.numbers("resolution");
        for (size_t axis = 0; axis < 3; ++axis) {
            settings.resolution[axis] = static_cast<uint32_t>(cells[axis]);
        }
    }
    settings.spacing = values.number("spacing");
    if (const Json* places = values.find("at")) {
        for (const Json& place : *places) {
            settings.places.emplace_back(place[0].get<double>(), place[1].get<double>(),
                                         place[2].get<double>());
        }
    }
    return settings;
}

Json quantiles_json(const DifferenceQuantiles& quantiles) {
    return {{"median", quantiles.median},
            {"p99", quantiles.p99},
            {"p999", quantiles.p999},
            {"worst", quantiles.worst}};
}

/// "3.1 %"
std::string percent(double share) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2g %%", 100.0 * share);
    return text;
}

std::string quantiles_text(const DifferenceQuantiles& quantiles) {
    return str_cat("median ", percent(quantiles.median), ", 1 of 100 above ",
                   percent(quantiles.p99), ", worst ", percent(quantiles.worst));
}

struct VolumeExport {
    const ExportTarget& target;
    std::string volume_path;
    std::string output;
    ExportSettings settings;
    CommonOptions common;

    [[nodiscard]] Status run() const {
        const auto file = open_probe_file(volume_path);
        if (!file) return not_probes().value_or(file.error());
        if (is_part(*file)) {
            return Error{ErrorCode::InvalidArgument, "volume", volume_path,
                         shown_path(volume_path) + ": is a part of a bake; merge its parts first"};
        }
        // Floats rather than half floats, where the file has both.
        const ProbeVolumeView volume =
            file->view().irradiance.empty() ? file->view() : file->view().without_compact();
        const auto exported = target.make(volume, settings);
        if (!exported) return named(exported.error());
        const auto paths = output_paths(*exported);
        if (!paths) return paths.error();
        for (size_t i = 0; i < paths->size(); ++i) {
            const std::string& content = exported->files[i].content;
            auto status = write_file((*paths)[i], std::as_bytes(std::span(content)));
            if (!status) return status;
        }
        common.warn_if_unlit(volume_path, file->view());
        common.report(output, json(*exported, *paths), text(*exported, *paths));
        return Ok{};
    }

    /// The error about a file of lightmaps or reflection probes; none if it is neither.
    [[nodiscard]] std::optional<Error> not_probes() const {
        const char* contents = is_lightmap_file(volume_path)     ? "lightmaps"
                               : is_reflection_file(volume_path) ? "reflection probes"
                                                                 : nullptr;
        if (contents == nullptr) return std::nullopt;
        return Error{ErrorCode::InvalidArgument, "as", target.name,
                     str_cat(shown_path(volume_path), ": contains ", contents, ", and ",
                             target.name, " is for probes")};
    }

    /// An error about the volume or about a setting.
    [[nodiscard]] Error named(Error error) const {
        if (error.field.empty()) {
            error = error.in(shown_path(volume_path));
            error.field = "volume";
            error.value = volume_path;
            return error;
        }
        return error.in(error.field == "places" ? "--at" : "--" + error.field);
    }

    /// The files that are written, checked. Those beside the first are in its folder.
    [[nodiscard]] Result<std::vector<std::string>> output_paths(
        const ExportedVolume& exported) const {
        std::vector<std::string> paths{output};
        if (output == "-" && exported.files.size() > 1) {
            return Error{ErrorCode::InvalidArgument, "output", output,
                         str_cat("-: cannot write ", exported.files.size(), " files to stdout")};
        }
        for (size_t i = 1; i < exported.files.size(); ++i) {
            paths.push_back((fs::path(output).parent_path() / exported.files[i].name).string());
        }
        for (const std::string& path : paths) {
            if (auto status = check_output(path, {volume_path}); !status) return status.error();
        }
        return paths;
    }

    [[nodiscard]] std::vector<std::string> losses(const ExportedVolume& exported) const {
        std::vector<std::string> losses = exported.notes;
        if (target.loses[0] != '\0') losses.insert(losses.begin(), target.loses);
        return losses;
    }

    [[nodiscard]] Json json(const ExportedVolume& exported,
                            const std::vector<std::string>& paths) const {
        Json json{
            {"output", output}, {"files", paths}, {"as", target.name}, {"lost", losses(exported)}};
        if (exported.difference) {
            json["difference"] = {
                {"places", exported.difference->place_count},
                {"from_light", quantiles_json(exported.difference->from_light)},
                {"without_walls", quantiles_json(exported.difference->without_walls)}};
        }
        return json;
    }

    [[nodiscard]] std::string text(const ExportedVolume& exported,
                                   const std::vector<std::string>& paths) const {
        std::string text;
        for (const std::string& path : paths) text += str_cat(text.empty() ? "" : ", ", path);
        for (const std::string& loss : losses(exported)) text += "\n  Lost: " + loss;
        const bool is_beside = exported.difference && exported.difference->place_count == 0;
        if (is_beside && target.has_grid)
            text += "\n  The box holds no place inside the probes' hull";
        if (exported.difference && exported.difference->place_count > 0) {
            const LightDifference& difference = *exported.difference;
            text += str_cat(
                "\n  Difference from the volume at ", difference.place_count,
                " places, of the largest irradiance: ", quantiles_text(difference.from_light),
                "\n  The same if no wall hid probes: ", quantiles_text(difference.without_walls));
        }
        return text;
    }
};

}  // namespace

const ExportTarget* chosen_export_target(const Values& values) {
    if (values.is_given("as")) return find_export_target(values.text("as"));
    const std::string output = values.text("output");
    const auto has_extension = [&](const ExportTarget& target) {
        return output.ends_with(target.extension);
    };
    const auto targets = export_targets();
    if (std::ranges::count_if(targets, has_extension) != 1) return nullptr;
    return &*std::ranges::find_if(targets, has_extension);
}

Status export_volume(const Values& values, const ExportTarget& target) {
    check_settings(values, target);
    return VolumeExport{target, values.text("volume"), values.text("output"),
                        export_settings(values, target), CommonOptions(values)}
        .run();
}

}  // namespace tetralight::cli
