// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/lightmap_report.h>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/amounts.h>

namespace tetralight::cli {

Json light_json(const LightmapReport& report) {
    return {{"samples_per_texel",
             {{"min", report.min_samples},
              {"median", report.median_samples},
              {"max", report.max_samples}}},
            {"standard_error", to_json(errors_of(report))},
            {"over_target", report.over_target_count},
            {"rays", report.ray_count},
            {"seconds",
             {{"layout", report.layout_seconds},
              {"texels", report.texel_seconds},
              {"bake", report.bake_seconds},
              {"cache", report.cache_seconds}}}};
}

std::string times_text(const LightmapReport& report) {
    return str_cat(
        "layout ", duration(report.layout_seconds), ", texels ", duration(report.texel_seconds),
        ", bake ", duration(report.bake_seconds), " (",
        report.cache_seconds > 0.0 ? "cached light " + duration(report.cache_seconds) + ", " : "",
        magnitude(static_cast<double>(report.ray_count)), "rays)");
}

TexelErrors errors_of(const LightmapReport& report) {
    return {report.median_error, report.worst_error};
}

Json to_json(const TexelErrors& errors) {
    if (errors.worst == 0.0f) return nullptr;
    return {{"median", errors.median}, {"worst", errors.worst}};
}

std::string to_text(const TexelErrors& errors) {
    if (errors.worst == 0.0f) return "standard error: not known";
    return str_cat("standard error: median ", percent(errors.median), ", worst ",
                   percent(errors.worst));
}

Json pages_json(const LightmapsView& maps, const LightmapReport& report) {
    return {{"pages", maps.info.page_count},
            {"page_size", maps.info.page_size},
            {"charts", report.chart_count},
            {"texels", report.texel_count},
            {"invalid", report.invalid_count},
            {"baked", report.baked_count},
            {"seams", report.seam_count},
            {"seam_difference",
             {{"baked", report.seam_difference_baked}, {"stitched", report.seam_difference}}}};
}

std::string pages_line(const LightmapsView& maps, const LightmapReport& report) {
    return str_cat(counted(maps.info.page_count, "page"), " of ", maps.info.page_size, " x ",
                   maps.info.page_size, ", ", counted(report.chart_count, "chart"), ", ",
                   counted(report.texel_count, "texel"), " (", grouped(report.invalid_count),
                   " inside geometry)");
}

std::string seams_text(const LightmapReport& report) {
    return str_cat(counted(report.seam_count, "seam"), ", 99 % differ by less than ",
                   percent(report.seam_difference), " (", percent(report.seam_difference_baked),
                   " before they were stitched)");
}

void report_lightmaps(const CommonOptions& common, const std::string& output,
                      const LightmapsView& maps, const LightmapReport& report) {
    Json json{{"output", output}};
    json.update(pages_json(maps, report));
    json.update(light_json(report));
    common.report(output, json,
                  str_cat(output, ": ", pages_line(maps, report), "\n  ", times_text(report),
                          "\n  ", seams_text(report), "\n  ", to_text(errors_of(report))));
}

}  // namespace tetralight::cli
