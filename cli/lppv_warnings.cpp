// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/lppv_warnings.h>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/amounts.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/walls_report.h>

namespace tetralight::cli {
namespace {

/// "; probes at (1, 0.5, 2), (4, 0.5, 2) would help most". Empty without positions.
std::string helpful_probes(const LppvCoverage& coverage, Cover cover) {
    constexpr size_t kMostShown = 3;
    std::vector<std::string> shown;
    for (const UncoveredPoint& point : coverage.positions) {
        if (point.cover != cover || shown.size() == kMostShown) continue;
        shown.push_back(position_text(point.position));
    }
    if (shown.empty()) return "";
    return str_cat(shown.size() == 1 ? "; a probe at " : "; probes at ", joined(shown),
                   " would help most");
}

}  // namespace

std::vector<std::string> half_warnings(float largest, const LppvFileSettings& file) {
    const bool is_half =
        file.precision == LppvTexelFormat::Half && file.kind != LppvFileKind::NanoVdb;
    if (!is_half || largest <= kLargestHalf) return {};
    return {str_cat("values of up to ", largest, " were cut to ", kLargestHalf,
                    ", the largest half; --precision float keeps them")};
}

std::vector<std::string> lppv_warnings(const Lppv& lppv, const LppvFileSettings& file) {
    std::vector<std::string> warnings = half_warnings(largest_value(lppv, file), file);
    if (!is_texture(file.kind)) return warnings;
    if (file.layout == LppvLayout::SevenSlabs && !lppv.occlusion.empty()) {
        warnings.emplace_back(
            "seven slabs have no room for the occlusion that the probes hold; --layout four and "
            "files of other kinds keep it");
    }
    if (file.layout == LppvLayout::FourSlabs && lppv.quality == LppvQuality::Full) {
        warnings.emplace_back(
            "four slabs hold band 2 as its mean alone; --layout seven and files of other kinds "
            "keep all of it");
    }
    return warnings;
}

std::vector<std::string> coverage_warnings(const LppvCoverage& coverage) {
    constexpr double kMostUncovered = 0.01;
    std::vector<std::string> warnings;
    const auto add = [&](Cover cover, const char* what) {
        if (!(coverage.points.share(cover) > kMostUncovered)) return;
        warnings.push_back(str_cat(grouped(coverage.points.count(cover)), " of ",
                                   counted(coverage.points.place_count(), "point"), " (",
                                   percent(coverage.points.share(cover)), ") ", what,
                                   helpful_probes(coverage, cover)));
    };
    add(Cover::HullCell, "lie outside of the tetrahedra and take the light of the nearest probes");
    add(Cover::Unseen,
        "are hidden by walls from the probes around them and take light through these walls");
    return warnings;
}

}  // namespace tetralight::cli
