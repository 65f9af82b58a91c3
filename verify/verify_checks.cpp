// SPDX-License-Identifier: Apache-2.0
#include <tetralight/verify/verify_checks.h>

#include <cmath>

#include <tetralight/base/str_cat.h>
#include <tetralight/verify/html.h>

namespace tetralight {
namespace {

/// `reason` stands between the value and the limit in the sentence of a failure.
VerifyCheck at_most(const char* setting, std::string what, double value, double limit,
                    const std::string& reason) {
    return {setting,
            std::move(what),
            percent_text(value),
            "at most " + percent_text(limit),
            value <= limit,
            percent_text(value) + reason + percent_text(limit)};
}

VerifyCheck within_3_sigma(const VerifyChannel& channel, const std::string& name, double limit) {
    const std::string value = percent_text(channel.within_3_sigma);
    return {"min_within",
            "decided probes within 3 standard errors, " + name,
            value,
            "at least " + percent_text(limit),
            channel.within_3_sigma >= limit,
            str_cat(name, " mean irradiance: ", value, " of ", channel.decided_count,
                    " probes are within 3 standard errors, fewer than ", percent_text(limit))};
}

/// The mean of n independent z has a standard error of 1 / √n.
VerifyCheck mean_z(const VerifyChannel& channel, const std::string& name, double limit) {
    const double chance = 3.0 / std::sqrt(static_cast<double>(channel.decided_count));
    const std::string value = fixed_point(channel.mean_z, 3), most = fixed_point(limit, 3);
    const std::string by_chance = fixed_point(chance, 3);
    return {"max_mean_z",
            "mean z of decided probes, " + name,
            value,
            str_cat("at most ±", most, " and ±", by_chance, " of chance"),
            std::abs(channel.mean_z) <= limit + chance,
            str_cat(name, " mean irradiance: the mean difference is ", value,
                    " standard errors over ", channel.decided_count, " probes, beyond ", most,
                    " and what chance allows (", by_chance, ")")};
}

void add_channel(std::vector<VerifyCheck>& checks, const VerifyChannel& channel,
                 const std::string& name, const VerifyLimits& limits) {
    if (channel.decided_count > 0) {
        checks.push_back(within_3_sigma(channel, name, limits.min_within));
        checks.push_back(mean_z(channel, name, limits.max_mean_z));
    }
    checks.push_back(at_most("max_undecided", "undecided probes, " + name, channel.undecided,
                             limits.max_undecided, " of the probes are undecided, more than "));
    std::string& failure = checks.back().failure;
    failure = name + " mean irradiance: " + failure;
}

void add_places(std::vector<VerifyCheck>& checks, const VerifyReport& report,
                const VerifyLimits& limits) {
    checks.push_back(
        at_most("max_leak_share", "places with much more light than the referee finds",
                report.leak_share, limits.max_leak_share,
                " of the places have much more light than the referee finds, more than "));
    checks.push_back(at_most("max_unseen_share", "places that see no probe of their cell",
                             report.unseen_share, limits.max_unseen_share,
                             " of the places see no probe of their cell, more than "));
    checks.push_back(
        at_most("max_interpolation", "mean difference of interpolated light, of the mean light",
                report.interpolation.mean, limits.max_interpolation,
                " of the mean light is the mean difference of interpolated light, more than "));
}

}  // namespace

std::vector<VerifyCheck> list_checks(const VerifyReport& report, const VerifyLimits& limits) {
    std::vector<VerifyCheck> checks;
    for (size_t i = 0; i < report.channels.size() && !report.probes.empty(); ++i) {
        add_channel(checks, report.channels[i], kChannelNames[i], limits);
    }
    if (!report.places.empty()) add_places(checks, report, limits);
    return checks;
}

std::vector<VerifyFailure> check_limits(const VerifyReport& report, const VerifyLimits& limits) {
    std::vector<VerifyFailure> failures;
    for (VerifyCheck& check : list_checks(report, limits)) {
        if (!check.is_kept) {
            failures.push_back({std::move(check.setting), std::move(check.failure)});
        }
    }
    return failures;
}

}  // namespace tetralight
