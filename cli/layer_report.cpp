// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/layer_report.h>

#include <algorithm>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/amounts.h>

namespace tetralight::cli {

Json to_json(const NoiseStatistics& noise) {
    if (noise.probe_count == 0) return nullptr;
    return {{"median", noise.median},
            {"p99", noise.p99},
            {"worst", noise.worst},
            {"known", noise.probe_count}};
}

std::string to_text(const NoiseStatistics& noise) {
    if (noise.probe_count == 0) return "not known";
    return str_cat("median ", percent(noise.median), ", 99 % below ", percent(noise.p99),
                   ", worst ", percent(noise.worst));
}

Json layer_noise_json(const ProbeVolumeView& volume) {
    const auto names = split_names(volume.layer_names);
    const auto noise = layer_noise(volume);
    Json layers = Json::array();
    for (size_t i = 0; i < names.size() && i < volume.layers.size(); ++i) {
        layers.push_back(
            {{"name", names[i]},
             {"standard_error", to_json(i < noise.size() ? noise[i] : NoiseStatistics{})}});
    }
    return layers;
}

std::string layer_noise_text(const ProbeVolumeView& volume) {
    const auto names = split_names(volume.layer_names);
    const auto noise = layer_noise(volume);
    std::string lines;
    for (size_t i = 0; i < std::min(names.size(), noise.size()); ++i) {
        lines += str_cat("\n  layer ", printable(std::string(names[i])), ": ", to_text(noise[i]));
    }
    return lines;
}

}  // namespace tetralight::cli
