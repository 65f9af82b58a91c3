// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/probe_warnings.h>

#include <algorithm>

#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

constexpr uint32_t kEnoughSamples = 64;

bool is_dark(const IrradianceSh& irradiance) {
    return irradiance.coefficients[0] == glm::vec3(0.0f);
}

}  // namespace

std::string no_light_warning(const char* place) {
    return str_cat("no ", place,
                   " receives any light: the scene has no sky, no emission and no light that is "
                   "baked, or none that reaches them");
}

void add_dark_warnings(const MergedProbes& merged, std::span<const IrradianceSh> irradiance,
                       uint32_t sample_count, std::vector<std::string>& warnings) {
    if (sample_count < kEnoughSamples || irradiance.empty()) return;
    if (std::ranges::all_of(irradiance, is_dark)) {
        warnings.push_back(no_light_warning("probe"));
        return;
    }
    std::vector<size_t> dark(merged.group_names.size(), 0);
    std::vector<size_t> total(merged.group_names.size(), 0);
    for (const ProbeSource& source : merged.sources) {
        if (source.probe == kNoIndex) continue;
        ++total[source.group];
        dark[source.group] += is_dark(irradiance[source.probe]);
    }
    for (size_t g = 0; g < dark.size(); ++g) {
        if (dark[g] == 0) continue;
        warnings.push_back(
            str_cat("group \"", merged.group_names[g], "\": ", dark[g], " of ", total[g],
                    " probes receive no light at all (in closed hollows?); what they "
                    "light will be black"));
    }
}

}  // namespace tetralight
