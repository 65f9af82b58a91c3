// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/bake_report.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/lightmap_files.h>
#include <tetralight/cli/lightmap_report.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/walls_report.h>
#include <tetralight/lightmap/lightmap_file.h>
#include <tetralight/pipeline/merge_parts.h>
#include <tetralight/probes/probe_file.h>

namespace tetralight::cli {
namespace {

struct Merge {
    std::vector<std::string> parts;
    std::string prepared;
    std::string output;
    CommonOptions common;

    explicit Merge(const Values& values)
        : parts(values.texts("parts")),
          prepared(values.text("prepared")),
          output(values.text("output")),
          common(values) {}

    Status run() {
        std::vector<std::string> inputs = parts;
        if (!prepared.empty()) inputs.push_back(prepared);
        if (auto status = check_output(output, inputs); !status) return status;
        const bool has_lightmaps = is_lightmap_file(parts[0]);
        if (auto status =
                check_output_kind(parts[0], output, has_lightmaps ? "lightmaps" : "probes");
            !status)
            return status;
        return has_lightmaps ? merge_lightmaps() : merge_probes();
    }

    [[nodiscard]] Status merge_lightmaps() const {
        const auto merged = merge_lightmap_parts(parts, common.thread_count);
        if (!merged) return merged.error();
        const LightmapReport& report = merged->report;
        common.warn(report.warnings);
        const LightmapsView maps = merged->lightmaps.view();
        if (auto status = write_lightmap_file(output, maps); !status) return status;
        Json json{{"output", output}, {"parts", parts.size()}};
        json.update(pages_json(maps, report));
        json.update(light_json(report));
        json.erase("seconds");  // parts do not keep them
        common.report(
            output, json,
            str_cat(output, ": ", pages_line(maps, report), " of ", counted(parts.size(), "part"),
                    "\n  ", seams_text(report), "\n  ", to_text(errors_of(report))));
        return Ok{};
    }

    [[nodiscard]] Status merge_probes() const {
        const auto merged =
            prepared.empty() ? merge_parts(parts) : merge_light_parts(prepared, parts);
        if (!merged) return merged.error();
        common.warn(merged->report.warnings);
        const ProbeVolumeView volume = merged->volume.view();
        if (auto status = write_probe_file(output, volume); !status) return status;

        Json json{{"output", output}, {"parts", parts.size()}};
        json.update(counts(volume));
        json.update(
            {{"dilated", merged->report.dilated_count}, {"rays", merged->report.ray_count}});
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
