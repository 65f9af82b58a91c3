// SPDX-License-Identifier: Apache-2.0
#include "probes/build/tetrahedralize.h"

#include "base/text.h"
#include "cli/common.h"
#include "probes/build/make_probe_volume.h"
#include "probes/probe_file.h"

namespace tetralight::cli {
namespace {

struct Tetrahedralize {
    std::vector<std::string> group_paths;
    std::string output;
    MergeSettings merge_settings;
    CommonOptions common;

    void add_to(CLI::App& command) {
        command.add_option("GROUPS", group_paths, "Probe groups: .json files, or glTF scenes")
            ->required();
        command.add_option("-o,--output", output, "Probe volume to write, without light (.probes)")
            ->required();
        command
            .add_option("--weld", merge_settings.weld_tolerance,
                        "Join probes nearer than this share of the set's diagonal")
            ->check(numbers_in(0.0, 0.1))
            ->capture_default_str();
        common.add_to(command);
    }

    Status run() {
        if (auto status = check_output(output, group_paths); !status) return status;
        const auto groups = read_groups(group_paths);
        if (!groups) return groups.error();
        const auto merged = merge(*groups, merge_settings);
        if (!merged) return merged.error();
        const auto volume = make_probe_volume(*merged);
        if (auto status = write_probe_file(output, volume.view()); !status) return status;
        Json json{{"output", output}};
        json.update(counts(volume.view()));
        common.report(output, json,
                      text(output, ": ", grouped(volume.positions.size()), " probes (",
                           grouped(merged->welded_count()), " welded), ", cells_text(volume.view()),
                           ", no light"));
        return Ok{};
    }
};

}  // namespace

void add_tetrahedralize(CLI::App& app, Run& run) {
    add_command<Tetrahedralize>(app, run, "tetrahedralize",
                                "Join probe groups in a volume without light",
                                "tetralight tetrahedralize grid.json -o grid.probes");
}

}  // namespace tetralight::cli
