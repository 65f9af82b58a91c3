// SPDX-License-Identifier: Apache-2.0
#include "probes/build/validate.h"

#include "base/text.h"
#include "cli/common.h"
#include "cli/paths.h"
#include "probes/probe_file.h"

namespace tetralight::cli {
namespace {

struct Validate {
    std::string path;
    CommonOptions common;

    void add_to(CLI::App& command) {
        add_path(command, "VOLUME", path, "Probe volume (.probes)")->required();
        common.add_to(command);
    }

    Status run() {
        const auto file = open_probe_file(path);
        if (!file) {
            if (common.is_json) common.print(verdict({file.error().message}), "");
            return file.error();
        }
        const ValidationReport report = validate(file->view());
        const std::vector<std::string> problems = report.problems();
        Json json = verdict(problems);
        json.update(counts(file->view()));
        json["cell_measure"] = report.cell_measure;
        json["hull_measure"] = report.hull_measure;
        common.print(json, text(path, ": ", problems.empty() ? "valid, " : "not valid, ",
                                grouped(file->view().probe_count()), " probes, Delaunay ",
                                cells_text(file->view())));
        if (problems.empty()) return Ok{};
        std::string message = path + ": ";
        for (const std::string& problem : problems) {
            message += (&problem == &problems[0] ? "" : "; ") + problem;
        }
        return Error{message};
    }

    [[nodiscard]] Json verdict(const std::vector<std::string>& problems) const {
        return {{"file", path}, {"is_valid", problems.empty()}, {"problems", problems}};
    }
};

}  // namespace

void add_validate(CLI::App& app, Run& run) {
    add_command<Validate>(app, run, "validate",
                          "Check a probe volume: checksums, structure, Delaunay property",
                          "tetralight validate courtyard.probes");
}

}  // namespace tetralight::cli
