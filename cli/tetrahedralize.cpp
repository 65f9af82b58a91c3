// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/tetrahedralize.h>

#include <cstdlib>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/backend_program.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/group_files.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/scene_reading.h>
#include <tetralight/probes/build/make_probe_volume.h>
#include <tetralight/probes/build/merge_warnings.h>
#include <tetralight/probes/probe_file.h>

namespace tetralight::cli {
namespace {

struct Tetrahedralize {
    std::vector<std::string> group_paths;
    SceneReading reading;
    std::string output;
    std::string backend;
    MergeSettings merge_settings;
    CommonOptions common;

    explicit Tetrahedralize(const Values& values)
        : group_paths(values.texts("groups")),
          reading(scene_reading(values)),
          output(values.text("output")),
          backend(values.text("backend")),
          merge_settings{.weld_tolerance = values.number("weld")},
          common(values) {}

    [[nodiscard]] Result<Tetrahedralization> cells_over(const MergedProbes& probes) const {
        if (backend == "tetralight")
            return tetrahedralize(probes.positions, flat_tolerance(probes));
        return tetrahedralize_with_program(probes.positions, flat_tolerance(probes),
                                           find_backend_program(backend));
    }

    /// An error of the program that joins probes, and why it was that one.
    [[nodiscard]] Error explained(const Error& error) const {
        const std::string variable = backend_variable(backend);
        const char* named = std::getenv(variable.c_str());
        if (named == nullptr || *named == '\0') return error;
        return {error.code, error.message.suffixed(str_cat(" (", variable, " names the program)"))};
    }

    [[nodiscard]] std::string metadata() const {
        return dump({{"generator", "tetralight " TETRALIGHT_VERSION}, {"backend", backend}});
    }

    Status run() {
        if (auto status = check_output(output, group_paths); !status) return status;
        const auto files = GroupFiles::read(group_paths, reading);
        if (!files) return files.error();
        common.warn(files->warnings());
        const auto merged = merge(files->groups(), merge_settings);
        if (!merged) return files->locate(merged.error());
        auto cells = cells_over(*merged);
        if (!cells) return explained(cells.error());
        common.warn(merge_warnings(*merged, cells->dimension));
        ProbeVolume volume = make_probe_volume(*merged, std::move(*cells));
        volume.metadata = metadata();
        if (auto status = write_probe_file(output, volume.view()); !status) return status;
        Json json{{"output", output}, {"backend", backend}};
        json.update(counts(volume.view()));
        const auto lattices = merged->lattice_group_names();
        json.update({{"lattice_groups", lattices}, {"largest_snap", merged->largest_snap}});
        common.report(
            output, json,
            str_cat(output, ": ", counted(volume.positions.size(), "probe"), " (",
                    merged_text(merged->welded_count(), lattices.size(), merged->largest_snap),
                    "), ", cells_text(volume.view()), ", no light"));
        return Ok{};
    }
};

}  // namespace

Status run_tetrahedralize(const Values& values) {
    return Tetrahedralize(values).run();
}

}  // namespace tetralight::cli
