// SPDX-License-Identifier: Apache-2.0
#include "probes/build/validate.h"

#include "base/text.h"
#include "cli/common.h"
#include "probes/probe_file.h"

namespace tetralight::cli {
namespace {

struct Validate {
    std::string path;
    CommonOptions common;

    void add_to(CLI::App& command) {
        command.add_option("VOLUME", path, "Probe volume (.probes)")->required();
        common.add_to(command);
    }

    Status run() {
        const auto file = open_probe_file(path);
        if (!file) return file.error();
        const ValidationReport report = validate(file->view());
        const std::vector<std::string> problems = report.problems();
        Json json{{"file", path}, {"is_valid", problems.empty()}, {"problems", problems}};
        json.update(counts(file->view()));
        json["cell_volume"] = report.cell_volume;
        json["hull_volume"] = report.hull_volume;
        common.print(json, problems.empty()
                               ? text(path, ": valid, ", grouped(file->view().probe_count()),
                                      " probes, ", grouped(file->view().info.tetrahedron_count),
                                      " Delaunay tetrahedra, ", report.hull_volume, " m³")
                               : text(path, ": not valid"));
        if (problems.empty()) return Ok{};
        std::string message = path + ": ";
        for (const std::string& problem : problems) {
            message += (&problem == &problems[0] ? "" : "; ") + problem;
        }
        return Error{message};
    }
};

}  // namespace

void add_validate(CLI::App& app, Run& run) {
    add_command<Validate>(app, run, "validate",
                          "Check a probe volume: checksums, structure, Delaunay property",
                          "tetralight validate courtyard.probes");
}

}  // namespace tetralight::cli
