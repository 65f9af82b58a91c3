// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <tetralight/verify/verify_report.h>

namespace tetralight {

/// One value of a report beside its limit.
struct VerifyCheck {
    /// The setting of the limit, for example "min_within".
    std::string setting;
    /// What is compared: "probes within 3 standard errors, red".
    std::string what;
    /// With units.
    std::string value;
    std::string limit;
    bool is_kept = true;
    /// What a `VerifyFailure` says if it is not kept.
    std::string failure;

    bool operator==(const VerifyCheck&) const = default;
};

/// All that has a limit in a report.
[[nodiscard]] std::vector<VerifyCheck> list_checks(const VerifyReport& report,
                                                   const VerifyLimits& limits);

/// One for each check that is not kept.
[[nodiscard]] std::vector<VerifyFailure> check_limits(const VerifyReport& report,
                                                      const VerifyLimits& limits);

}  // namespace tetralight
