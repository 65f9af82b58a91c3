// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/lppv_warnings.h>

#include <tetralight/base/str_cat.h>

namespace tetralight::cli {

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

}  // namespace tetralight::cli
