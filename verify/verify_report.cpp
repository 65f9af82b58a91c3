// SPDX-License-Identifier: Apache-2.0
#include <tetralight/verify/verify_report.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace tetralight {
namespace {

/// Relative rounding error of light in floats.
constexpr double kRounding = 1e-5;

double median_of(std::vector<double> values) {
    if (values.empty()) return 0.0;
    std::ranges::sort(values);
    return values[values.size() / 2];
}

double quantile(const std::vector<double>& sorted, double share) {
    if (sorted.empty()) return 0.0;
    const double place = share * static_cast<double>(sorted.size());
    return sorted[std::min(sorted.size() - 1, static_cast<size_t>(place))];
}

double square(double x) {
    return x * x;
}

double bar_of(const VerifyProbe& probe, int channel) {
    const double rounding =
        kRounding * std::max(std::abs(probe.volume[channel]), probe.traced.mean[channel]);
    return std::sqrt(square(probe.volume_error[channel]) + square(probe.traced.error[channel]) +
                     square(rounding));
}

void compare_probe(const glm::dvec3& mean_light, const VerifyRules& rules, VerifyProbe& probe) {
    for (int channel = 0; channel < 3; ++channel) {
        const double bar = bar_of(probe, channel);
        const double difference = probe.volume[channel] - probe.traced.mean[channel];
        probe.z[channel] = bar > 0.0 ? difference / bar : 0.0;
        const double scale =
            std::max(probe.traced.mean[channel], rules.least_share * mean_light[channel]);
        const bool is_unknown = probe.volume_error[channel] == 0.0 && probe.volume[channel] != 0.0;
        probe.is_decided[static_cast<size_t>(channel)] =
            !is_unknown && bar <= rules.widest_bar * scale;
    }
}

glm::dvec3 mean_at_probes(const std::vector<VerifyProbe>& probes) {
    glm::dvec3 sum(0.0);
    for (const VerifyProbe& probe : probes) sum += probe.traced.mean;
    return probes.empty() ? sum : sum / static_cast<double>(probes.size());
}

VerifyChannel channel_of(const std::vector<VerifyProbe>& probes, int channel, double mean_light) {
    VerifyChannel figures;
    double within = 0.0, squares = 0.0, difference = 0.0;
    for (const VerifyProbe& probe : probes) {
        difference += probe.volume[channel] - probe.traced.mean[channel];
        if (!probe.is_decided[static_cast<size_t>(channel)]) continue;
        ++figures.decided_count;
        const double z = probe.z[channel];
        if (std::abs(z) <= 3.0) within += 1.0;
        figures.mean_z += z;
        squares += z * z;
    }
    const auto all = static_cast<double>(probes.size());
    const auto decided = static_cast<double>(figures.decided_count);
    if (figures.decided_count > 0) {
        figures.within_3_sigma = within / decided;
        figures.mean_z /= decided;
        figures.rms_z = std::sqrt(squares / decided);
    }
    if (!probes.empty()) figures.undecided = 1.0 - decided / all;
    if (mean_light > 0.0) figures.mean_difference = difference / all / mean_light;
    return figures;
}

/// Root mean square over all normals and channels, relative to the referee (Parseval's theorem).
double directional_difference(const VerifyProbe& probe) {
    double squares = 0.0, scale = 0.0;
    for (size_t i = 0; i < probe.irradiance.coefficients.size(); ++i) {
        const glm::dvec3 traced(probe.traced.irradiance.coefficients[i]);
        const glm::dvec3 difference = glm::dvec3(probe.irradiance.coefficients[i]) - traced;
        for (int channel = 0; channel < 3; ++channel) {
            squares += square(difference[channel]);
            scale += square(traced[channel]);
        }
    }
    return scale > 0.0 ? std::sqrt(squares / scale) : 0.0;
}

void summarize_probes(VerifyReport& report) {
    const glm::dvec3 mean_light = mean_at_probes(report.probes);
    std::vector<double> directional;
    for (VerifyProbe& probe : report.probes) {
        compare_probe(mean_light, report.rules, probe);
        probe.directional_difference = directional_difference(probe);
        directional.push_back(probe.directional_difference);
    }
    for (int channel = 0; channel < 3; ++channel) {
        report.channels[static_cast<size_t>(channel)] =
            channel_of(report.probes, channel, mean_light[channel]);
    }
    report.directional_difference = median_of(std::move(directional));
}

/// Standard error of luminance; the noise of the channels is that of the same paths.
double luminance_error(const TracedLight& traced) {
    return luminance(traced.error);
}

void summarize_places(VerifyReport& report) {
    if (report.places.empty()) return;
    const auto count = static_cast<double>(report.places.size());
    double sum = 0.0;
    for (const VerifyPlace& place : report.places) sum += luminance(place.traced.mean);
    report.mean_light = sum / count;
    report.leak_share = report.dark_share = report.unseen_share = report.outside_share = 0.0;
    std::vector<double> differences;
    double total = 0.0, noise = 0.0;
    for (VerifyPlace& place : report.places) {
        const double traced = luminance(place.traced.mean);
        const double difference = luminance(place.answer) - traced;
        const double bar = luminance_error(place.traced);
        const double floor = report.rules.leak_floor * report.mean_light + 3.0 * bar;
        const double ratio = report.rules.leak_ratio;
        place.is_leak = difference > ratio * traced && difference > floor;
        place.is_dark = -difference > ratio * traced && -difference > floor;
        report.leak_share += place.is_leak ? 1.0 / count : 0.0;
        report.dark_share += place.is_dark ? 1.0 / count : 0.0;
        report.unseen_share += place.is_unseen ? 1.0 / count : 0.0;
        report.outside_share += place.is_outside ? 1.0 / count : 0.0;
        if (!(report.mean_light > 0.0)) continue;
        differences.push_back(std::abs(difference) / report.mean_light);
        total += differences.back();
        constexpr double kMeanOfNormal = 0.7978845608028654;  // √(2/π), of |z|
        noise += kMeanOfNormal * bar / report.mean_light;
    }
    std::ranges::sort(differences);
    report.interpolation = {total / count, quantile(differences, 0.5), quantile(differences, 0.95),
                            noise / count};
}

}  // namespace

glm::dvec3 mean_over_normals(const IrradianceSh& irradiance) noexcept {
    constexpr double kFirstBasis = 0.28209479177387814;  // 1 / (2 √π)
    return kFirstBasis * glm::dvec3(irradiance.coefficients[0]);
}

double luminance(const glm::dvec3& light) noexcept {
    return 0.2126 * light.x + 0.7152 * light.y + 0.0722 * light.z;
}

void summarize(VerifyReport& report) {
    report.sample_count = 0;
    for (const VerifyProbe& probe : report.probes) report.sample_count += probe.traced.sample_count;
    for (const VerifyPlace& place : report.places) report.sample_count += place.traced.sample_count;
    summarize_probes(report);
    summarize_places(report);
}

}  // namespace tetralight
