// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/validate.h>

#include <tetralight/base/error_text.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/paths.h>
#include <tetralight/probes/build/check_metadata.h>
#include <tetralight/probes/probe_file.h>

namespace tetralight::cli {
namespace {

Json to_json(const ValidationReport& report) {
    return {{"inverted_cells", report.inverted_cells},
            {"non_delaunay_faces", report.non_delaunay_faces},
            {"concave_hull_edges", report.concave_hull_edges},
            {"probes_without_cell", report.probes_without_cell},
            {"probes_without_source", report.probes_without_source},
            {"misplaced_float_probes", report.misplaced_float_probes},
            {"wrong_compact_probes", report.wrong_compact_probes},
            {"cell_measure", report.cell_measure},
            {"hull_measure", report.hull_measure}};
}

struct Validate {
    std::string path;
    CommonOptions common;

    void add_to(CLI::App& command) {
        add_path(command, "VOLUME", path, "Probe volume (.probes)")->required();
        common.add_to(command);
    }

    Status run() {
        const auto file = open_volume();
        if (!file) {
            if (common.is_json) common.print(verdict({error_text(file.error())}), "");
            return file.error();
        }
        const ValidationReport report = validate(file->view());
        const std::vector<std::string> problems = report.problems();
        Json json = verdict(problems);
        json.update(counts(file->view()));
        json.update(to_json(report));
        common.print(json,
                     str_cat(printable(path), problems.empty() ? ": valid, " : ": not valid, ",
                             counted(file->view().probe_count(), "probe"), ", ",
                             problems.empty() ? "Delaunay " : "", cells_text(file->view())));
        if (problems.empty()) return Ok{};
        std::string message = path + ": ";
        for (const std::string& problem : problems) {
            message += (&problem == &problems[0] ? "" : "; ") + problem;
        }
        return Error{message};
    }

    /// The volume with its metadata checked.
    [[nodiscard]] Result<ProbeFile> open_volume() const {
        auto file = open_probe_file(path);
        if (!file) return file;
        const Status status = check_metadata(file->view().metadata);
        if (!status) return status.error().in(shown_path(path));
        return file;
    }

    /// A file that cannot be opened has this part alone: nothing of it was counted.
    [[nodiscard]] Json verdict(const std::vector<std::string>& problems) const {
        return {{"file", path}, {"is_valid", problems.empty()}, {"problems", problems}};
    }
};

}  // namespace

void add_validate(CLI::App& app, Run& run) {
    add_command<Validate>(app, run, "validate",
                          "Check a probe volume: checksums, structure, Delaunay property",
                          "tetralight validate courtyard.probes --json");
}

}  // namespace tetralight::cli
