// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdio>

#include <tetralight/base/str_cat.h>
#include <tetralight/verify/verify_report.h>

namespace tetralight {
namespace {

std::string percent(double share) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f %%", 100.0 * share);
    return text;
}

std::string decimal(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3f", number);
    return text;
}

/// Collects what is beyond its limit.
class Check {
  public:
    void channels(const VerifyReport& report, const VerifyLimits& limits) {
        if (report.probes.empty()) return;
        for (size_t i = 0; i < report.channels.size(); ++i) {
            const VerifyChannel& channel = report.channels[i];
            const std::string name = str_cat(kChannelNames[i], " mean irradiance: ");
            if (channel.undecided > limits.max_undecided) {
                add("max_undecided", str_cat(name, percent(channel.undecided),
                                             " of the probes are undecided, more "
                                             "than ",
                                             percent(limits.max_undecided)));
            }
            if (channel.decided_count == 0) continue;
            if (channel.within_3_sigma < limits.min_within) {
                add("min_within",
                    str_cat(name, percent(channel.within_3_sigma), " of ", channel.decided_count,
                            " probes are within 3 standard errors, fewer than ",
                            percent(limits.min_within)));
            }
            mean_z(channel, name, limits.max_mean_z);
        }
    }

    void places(const VerifyReport& report, const VerifyLimits& limits) {
        share("max_leak_share", report.leak_share, limits.max_leak_share,
              " of the places have much more light than the referee finds, more than ");
        share("max_unseen_share", report.unseen_share, limits.max_unseen_share,
              " of the places see no probe of their cell, more than ");
        share("max_interpolation", report.interpolation.mean, limits.max_interpolation,
              " of the mean light is the mean difference of interpolated light, more than ");
    }

    [[nodiscard]] std::vector<VerifyFailure> failures() && { return std::move(failures_); }

  private:
    /// The mean of n independent z has a standard error of 1 / √n.
    void mean_z(const VerifyChannel& channel, const std::string& name, double limit) {
        const double chance = 3.0 / std::sqrt(static_cast<double>(channel.decided_count));
        if (std::abs(channel.mean_z) <= limit + chance) return;
        add("max_mean_z",
            str_cat(name, "the mean difference is ", decimal(channel.mean_z),
                    " standard errors over ", channel.decided_count, " probes, beyond ",
                    decimal(limit), " and what chance allows (", decimal(chance), ")"));
    }

    void share(const char* setting, double value, double limit, const char* reason) {
        if (value > limit) add(setting, str_cat(percent(value), reason, percent(limit)));
    }

    void add(const char* setting, std::string message) {
        failures_.push_back({setting, std::move(message)});
    }

    std::vector<VerifyFailure> failures_;
};

}  // namespace

std::vector<VerifyFailure> check_limits(const VerifyReport& report, const VerifyLimits& limits) {
    Check check;
    check.channels(report, limits);
    if (!report.places.empty()) check.places(report, limits);
    return std::move(check).failures();
}

}  // namespace tetralight
