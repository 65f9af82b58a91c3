// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/bake_report.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/walls_report.h>
#include <tetralight/pipeline/merge_parts.h>
#include <tetralight/probes/probe_file.h>

namespace tetralight::cli {
namespace {

struct Merge {
    std::vector<std::string> parts;
    std::string output;
    CommonOptions common;

    explicit Merge(const Values& values)
        : parts(values.texts("parts")), output(values.text("output")), common(values) {}

    Status run() {
        if (auto status = check_output(output, parts); !status) return status;
        const auto merged = merge_parts(parts);
        if (!merged) return merged.error();
        common.warn(merged->report.warnings);
        const ProbeVolumeView volume = merged->volume.view();
        if (auto status = write_probe_file(output, volume); !status) return status;

        Json json{{"output", output}, {"parts", parts.size()}};
        json.update(counts(volume));
        json.update({{"rays", merged->report.ray_count}});
        json["walls"] = to_json(merged->report.visibility);
        json["unseen"] = to_json(merged->report.unseen);
        json.update(to_json(merged->report.statistics));
        common.report(output, json,
                      str_cat(output, ": ", counted(volume.probe_count(), "probe"), " of ",
                              counted(parts.size(), "part"), ", ", cells_text(volume), "\n  ",
                              to_text(merged->report.statistics), walls_text(merged->report)));
        return Ok{};
    }
};

}  // namespace

Status run_merge(const Values& values) {
    return Merge(values).run();
}

}  // namespace tetralight::cli
