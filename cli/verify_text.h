// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/verify/verify_report.h>

namespace tetralight::cli {

/// The report of `verify` as lines for people, without a line break at the end.
[[nodiscard]] std::string verify_text(const VerifyReport& report);

}  // namespace tetralight::cli
