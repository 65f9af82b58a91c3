// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/bake_report.h>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/amounts.h>
#include <tetralight/cli/layer_report.h>
#include <tetralight/cli/leak_report.h>
#include <tetralight/cli/walls_report.h>

namespace tetralight::cli {
namespace {

/// Rays a second of this run.
double ray_rate(uint64_t ray_count, const BakeRun& run) {
    return static_cast<double>(ray_count - run.earlier_ray_count) / run.seconds;
}

/// What was asked for, and the rays that it took.
Json work(uint64_t ray_count, const BakeRun& run) {
    return {{"samples", run.settings.sample_count},
            {"bounces", run.settings.bounces},
            {"rays", ray_count},
            {"rays_per_second", ray_rate(ray_count, run)}};
}

/// "2.3 s (3.4 Mrays, 1.5 Mrays/s)".
std::string work_text(uint64_t ray_count, const BakeRun& run) {
    return str_cat(duration(run.seconds), " (", magnitude(static_cast<double>(ray_count)), "rays, ",
                   magnitude(ray_rate(ray_count, run)), "rays/s)");
}

/// What became of probes in geometry, if there are any, and how many were not baked.
std::string health_text(const BakeReport& report) {
    std::string parts;
    if (report.virtual_offset_count > 0)
        parts += ", " + grouped(report.virtual_offset_count) + " moved";
    if (report.left_out_count > 0) parts += ", " + grouped(report.left_out_count) + " left out";
    if (report.dilated_count > 0) parts += ", " + grouped(report.dilated_count) + " dilated";
    if (report.reused_count > 0) parts += ", " + grouped(report.reused_count) + " reused";
    return parts;
}

/// null: not known of any probe.
Json errors_json(const BakeStatistics& statistics) {
    if (statistics.known_error_count == 0) return nullptr;
    return {{"median", statistics.median_error},
            {"p99", statistics.p99_error},
            {"worst", statistics.worst_error},
            {"known", statistics.known_error_count}};
}

/// "median 0.50 %, 99 % below 1.20 %, worst 3.00 %".
std::string errors_text(const BakeStatistics& statistics) {
    if (statistics.known_error_count == 0) return "not known";
    return str_cat("median ", percent(statistics.median_error), ", 99 % below ",
                   percent(statistics.p99_error), ", worst ", percent(statistics.worst_error));
}

}  // namespace

void report_volume(const CommonOptions& common, const BakeRun& run, const BakedVolume& baked,
                   const LeakReport* leaks) {
    const ProbeVolumeView volume = baked.volume.view();
    const BakeReport& report = baked.report;
    Json json{{"output", run.output}};
    json.update(counts(volume));
    json.update(
        {{"lattice_groups", report.lattice_group_names}, {"largest_snap", report.largest_snap}});
    json.update({{"moved", report.virtual_offset_count},
                 {"left_out", report.left_out_count},
                 {"dilated", report.dilated_count},
                 {"reused", report.reused_count}});
    json["walls"] = to_json(report.visibility);
    json["unseen"] = to_json(report.unseen);
    json.update(work(report.ray_count, run));
    json.update(to_json(report.statistics));
    json["layers"] = layer_noise_json(volume);
    json["seconds"] = {{"merge", report.merge_seconds},
                       {"prepare", report.prepare_seconds},
                       {"tetrahedralize", report.tetrahedralize_seconds},
                       {"walls", report.visibility.seconds},
                       {"unseen", report.unseen_seconds},
                       {"bake", run.seconds}};
    if (leaks != nullptr) json["leaks"] = to_json(*leaks);
    common.report(run.output, json,
                  str_cat(run.output, ": ", counted(volume.probe_count(), "probe"), " (",
                          merged_text(report.welded_count, report.lattice_group_names.size(),
                                      report.largest_snap),
                          health_text(report), "), ", cells_text(volume), "\n  merge ",
                          duration(report.merge_seconds), ", tetrahedralize ",
                          duration(report.tetrahedralize_seconds), ", bake ",
                          work_text(report.ray_count, run), "\n  ", to_text(report.statistics),
                          layer_noise_text(volume), walls_text(report),
                          leaks == nullptr ? "" : "\n" + to_text(*leaks)));
}

void report_range(const CommonOptions& common, const BakeRun& run, const PartialBake& part,
                  size_t probe_count) {
    const BakedProbes light = make_baked_probes(part.accumulators);
    const BakeStatistics statistics = bake_statistics(light, run.settings.target_error);
    Json json{{"output", run.output},
              {"range", {part.range.begin, part.range.end}},
              {"step", part.range.step},
              {"probes", part.range.count()},
              {"all_probes", probe_count}};
    json.update(work(light.ray_count, run));
    json.update(to_json(statistics));
    json["seconds"] = {{"bake", run.seconds}};
    common.report(
        run.output, json,
        str_cat(run.output, ": probes ", name_of(part.range), " of ", grouped(probe_count),
                "\n  bake ", work_text(light.ray_count, run), "\n  ", to_text(statistics)));
}

Json to_json(const BakeStatistics& statistics) {
    return {{"samples_per_probe",
             {{"min", statistics.min_samples},
              {"median", statistics.median_samples},
              {"max", statistics.max_samples}}},
            {"standard_error", errors_json(statistics)},
            {"over_target", statistics.over_target_count}};
}

std::string to_text(const BakeStatistics& statistics) {
    std::string directions = grouped(statistics.median_samples);
    if (statistics.min_samples != statistics.max_samples) {
        directions = str_cat(grouped(statistics.min_samples), " to ",
                             grouped(statistics.max_samples), " (median ", directions, ")");
    }
    return str_cat(
        directions, " samples a probe; standard error: ", errors_text(statistics),
        statistics.over_target_count == 0
            ? ""
            : str_cat("; ", counted(statistics.over_target_count, "probe"), " above the target"));
}

}  // namespace tetralight::cli
