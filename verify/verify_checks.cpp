// SPDX-License-Identifier: Apache-2.0
#include <tetralight/verify/verify_checks.h>

#include <cmath>

#include <tetralight/base/str_cat.h>
#include <tetralight/verify/html.h>

namespace tetralight {
namespace {

VerifyCheck at_most(const char* setting, std::string what, double value, double limit) {
    return {setting, std::move(what), percent_text(value), "at most " + percent_text(limit),
            value <= limit};
}

void add_decided(std::vector<VerifyCheck>& checks, const VerifyChannel& channel,
                 const std::string& name, const VerifyLimits& limits) {
    checks.push_back({"min_within", "decided probes within 3 standard errors, " + name,
                      percent_text(channel.within_3_sigma),
                      "at least " + percent_text(limits.min_within),
                      channel.within_3_sigma >= limits.min_within});
    const double chance = 3.0 / std::sqrt(static_cast<double>(channel.decided_count));
    checks.push_back({"max_mean_z", "mean z of decided probes, " + name,
                      fixed_point(channel.mean_z, 3),
                      str_cat("at most ±", fixed_point(limits.max_mean_z, 3), " and ±",
                              fixed_point(chance, 3), " of chance"),
                      std::abs(channel.mean_z) <= limits.max_mean_z + chance});
}

}  // namespace

std::vector<VerifyCheck> list_checks(const VerifyReport& report, const VerifyLimits& limits) {
    std::vector<VerifyCheck> checks;
    for (size_t i = 0; i < report.channels.size() && !report.probes.empty(); ++i) {
        const VerifyChannel& channel = report.channels[i];
        if (channel.decided_count > 0) add_decided(checks, channel, kChannelNames[i], limits);
        checks.push_back(at_most("max_undecided", str_cat("undecided probes, ", kChannelNames[i]),
                                 channel.undecided, limits.max_undecided));
    }
    if (report.places.empty()) return checks;
    checks.push_back(at_most("max_leak_share", "places with much more light than the referee finds",
                             report.leak_share, limits.max_leak_share));
    checks.push_back(at_most("max_unseen_share", "places that see no probe of their cell",
                             report.unseen_share, limits.max_unseen_share));
    checks.push_back(at_most("max_interpolation",
                             "mean difference of interpolated light, of the mean light",
                             report.interpolation.mean, limits.max_interpolation));
    return checks;
}

}  // namespace tetralight
