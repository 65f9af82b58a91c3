// SPDX-License-Identifier: Apache-2.0
#include <span>

#include <tetralight/base/file.h>
#include <tetralight/base/json/check_metadata.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/explain_scene.h>
#include <tetralight/cli/info_probes.h>
#include <tetralight/cli/lightmap_files.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/reflection_files.h>
#include <tetralight/cli/scene_reading.h>
#include <tetralight/cli/volume_facts.h>
#include <tetralight/cli/world_report.h>
#include <tetralight/pipeline/partial_bake.h>
#include <tetralight/probes/build/wireframe.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/probes/world.h>

namespace tetralight::cli {
namespace {

Status write_text(const std::string& path, const std::string& text) {
    return write_file(path, std::as_bytes(std::span(text)));
}

struct Info {
    std::string path;
    std::string obj_path;
    std::string ply_path;
    bool shows_probes = false;
    bool is_scene = false;
    SceneReading reading;
    /// What is wrong if the file is not a scene.
    Status without_scene;
    CommonOptions common;

    explicit Info(const Values& values)
        : path(values.text("volume")),
          obj_path(values.text("obj")),
          ply_path(values.text("ply")),
          shows_probes(values.flag("probes")),
          is_scene(is_scene_file(path)),
          reading(scene_reading(values, NormalMaps::Read)),
          without_scene(check_no_scene_reading(values, "needs a glTF scene")),
          common(values) {
        if (obj_path == "-" && ply_path == "-") {
            refuse(values, "ply", values.shown("obj") + " goes to stdout already");
        }
        const bool has_two = !obj_path.empty() && !ply_path.empty();
        if (has_two && is_same_file(obj_path, ply_path)) {
            refuse(values, "ply", values.shown("obj") + " goes to the same file");
        }
    }

    Status run() {
        for (const std::string& output : {obj_path, ply_path}) {
            if (output.empty()) continue;
            if (auto status = check_output(output, {path}); !status) return status;
        }
        if (is_scene) return run_scene();
        if (!without_scene) return without_scene;
        if (is_world(path)) return run_of_world();
        if (is_lightmap_file(path)) return run_lightmaps();
        if (is_reflection_file(path)) return run_reflections();
        const auto file = open_probe_file(path);
        if (!file) return file.error();
        if (auto status = check_metadata(file->view().metadata); !status) {
            return status.error().in(shown_path(path));
        }
        if (auto status = write_wireframe(file->view()); !status) return status;
        const VolumeFacts facts = make_volume_facts(path, *file);
        const bool is_stdout_taken = obj_path == "-" || ply_path == "-";
        Json json = to_json(facts);
        std::string lines = to_text(facts, file->view());
        if (is_part(*file)) {
            const auto part = read_part(path);
            if (!part) return part.error();
            json["part"] = part_json(part->partial);
            lines += "\n" + part_text(part->partial, file->view().probe_count());
        }
        if (shows_probes) {
            json.update(probes_json(file->view()));
            lines += "\nhealth of the probes\n" + probes_text(file->view());
        }
        common.report(is_stdout_taken ? "-" : "", json, lines);
        return Ok{};
    }

    /// Anything besides the description.
    [[nodiscard]] bool has_other() const {
        return !obj_path.empty() || !ply_path.empty() || shows_probes;
    }

    [[nodiscard]] Status run_scene() const {
        if (!has_other()) return show_scene(path, reading, common);
        return Error{ErrorCode::InvalidArgument, "volume", path,
                     path + ": is a scene, which has no tetrahedra and no health of probes"};
    }

    [[nodiscard]] Status run_of_world() const {
        if (!has_other()) return show_world(path, common);
        return Error{ErrorCode::InvalidArgument, "volume", path,
                     path + ": is a world; describe its tiles (tile-*.probes) one by one"};
    }

    [[nodiscard]] Status run_lightmaps() const {
        if (!has_other()) return show_lightmaps(path, common);
        return Error{ErrorCode::InvalidArgument, "volume", path,
                     path + ": contains lightmaps, which have no probes and no tetrahedra"};
    }

    [[nodiscard]] Status run_reflections() const {
        if (!has_other()) return show_reflections(path, common);
        return Error{
            ErrorCode::InvalidArgument, "volume", path,
            path + ": contains reflection probes, which are always listed and have no tetrahedra"};
    }

    static Json part_json(const PartialBake& part) {
        return {{"range", {part.range.begin, part.range.end}},
                {"step", part.range.step},
                {"is_finished", true}};
    }

    static std::string part_text(const PartialBake& part, uint32_t probe_count) {
        return str_cat("part of a bake: probes ", name_of(part.range), " of ", grouped(probe_count),
                       ", finished");
    }

    [[nodiscard]] Status write_wireframe(const ProbeVolumeView& volume) const {
        if (obj_path.empty() && ply_path.empty()) return Ok{};
        const Wireframe wireframe = make_wireframe(volume);
        if (!obj_path.empty()) {
            if (auto status = write_text(obj_path, obj_text(wireframe)); !status) return status;
        }
        return ply_path.empty() ? Status(Ok{}) : write_text(ply_path, ply_text(wireframe));
    }
};

}  // namespace

Status run_info(const Values& values) {
    return Info(values).run();
}

}  // namespace tetralight::cli
