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

    bool operator==(const VerifyCheck&) const = default;
};

/// All checks of `check_limits`, which returns one failure for each that is not kept.
[[nodiscard]] std::vector<VerifyCheck> list_checks(const VerifyReport& report,
                                                   const VerifyLimits& limits);

}  // namespace tetralight
