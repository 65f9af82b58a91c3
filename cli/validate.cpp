// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/validate.h>

#include <optional>

#include <tetralight/base/json/check_metadata.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/failure.h>
#include <tetralight/cli/lightmap_files.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/reflection_files.h>
#include <tetralight/cli/scene_reading.h>
#include <tetralight/cli/walls_report.h>
#include <tetralight/pipeline/bake_metadata.h>
#include <tetralight/pipeline/unseen_places.h>
#include <tetralight/probes/probe_file.h>

namespace tetralight::cli {
namespace {

Json report_json(const ValidationReport& report) {
    return {{"inverted_cells", report.inverted_cells},
            {"non_delaunay_faces", report.non_delaunay_faces},
            {"concave_hull_edges", report.concave_hull_edges},
            {"inward_hull_rays", report.inward_hull_rays},
            {"torn_hull_rays", report.torn_hull_rays},
            {"probes_without_cell", report.probes_without_cell},
            {"probes_without_source", report.probes_without_source},
            {"misplaced_float_probes", report.misplaced_float_probes},
            {"wrong_compact_probes", report.wrong_compact_probes},
            {"wrong_layer_sums", report.wrong_layer_sums},
            {"torn_edges", report.torn_edges},
            {"cell_measure", report.cell_measure},
            {"hull_measure", report.hull_measure}};
}

struct Validate {
    std::string path;
    /// Empty: unseen space is not measured.
    std::string scene_path;
    SceneReading reading;
    CommonOptions common;

    explicit Validate(const Values& values)
        : path(values.text("volume")),
          scene_path(values.text("scene")),
          reading(scene_reading(values)),
          common(values) {}

    Status run() {
        if (is_lightmap_file(path)) return validate_lightmaps(path, common);
        if (is_reflection_file(path)) return run_reflections();
        const auto file = open_volume();
        if (!file && (can_retry(file.error().code) || file.error().code == ErrorCode::NotFound)) {
            return file.error();
        }
        if (!file) {
            const std::string problem = error_json(file.error())["message"];
            return with_report(file.error(), verdict({problem}));
        }
        const auto unseen = find_unseen_places(file->view());
        if (!unseen) return unseen.error();
        const ValidationReport report = validate(file->view());
        const std::vector<std::string> problems = report.problems();
        Json json = verdict(problems);
        json.update(counts(file->view()));
        json.update(report_json(report));
        if (*unseen) json["unseen"] = to_json(**unseen);
        const std::string line = str_cat(
            printable(path), problems.empty() ? ": valid, " : ": not valid, ",
            counted(file->view().probe_count(), "probe"), ", ", problems.empty() ? "Delaunay " : "",
            cells_text(file->view()), *unseen ? "\n  " + to_text(**unseen) : "");
        if (problems.empty() || !common.is_json) common.print(json, line);
        if (problems.empty()) return Ok{};
        std::string message = path + ": ";
        for (const std::string& problem : problems) {
            message += (&problem == &problems[0] ? "" : "; ") + problem;
        }
        return with_report({ErrorCode::Corrupt, message}, json);
    }

    [[nodiscard]] Status run_reflections() const {
        if (scene_path.empty()) return validate_reflections(path, common);
        return Error{ErrorCode::InvalidArgument, "scene", scene_path,
                     path + ": contains reflection probes, which are checked without a scene"};
    }

    /// None without a scene.
    [[nodiscard]] Result<std::optional<UnseenPlaces>> find_unseen_places(
        const ProbeVolumeView& volume) const {
        if (scene_path.empty()) return std::optional<UnseenPlaces>();
        const auto scene = read_scene(scene_path, reading);
        if (!scene) return scene.error();
        common.warn(scene->warnings);
        const auto recorded = recorded_settings(volume.metadata);
        if (!recorded) return recorded.error().in(path);
        auto unseen =
            measure_unseen(*scene, volume, recorded->health.min_validity, common.thread_count);
        if (!unseen) return unseen.error().in(scene_path);
        return std::optional(std::move(*unseen));
    }

    /// The volume with its metadata checked.
    [[nodiscard]] Result<ProbeFile> open_volume() const {
        auto file = open_probe_file(path);
        if (!file) return file;
        const Status status = check_metadata(file->view().metadata);
        if (!status) return status.error().in(shown_path(path));
        return file;
    }

    /// All there is to say of a file that cannot be opened.
    [[nodiscard]] Json verdict(const std::vector<std::string>& problems) const {
        return {{"file", path}, {"is_valid", problems.empty()}, {"problems", problems}};
    }
};

}  // namespace

Status run_validate(const Values& values) {
    return Validate(values).run();
}

}  // namespace tetralight::cli
