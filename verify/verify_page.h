// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <tetralight/verify/verify_report.h>

namespace tetralight {

/// A picture of the scene.
struct VerifyPicture {
    /// What it shows, one sentence; also read by screen readers.
    std::string caption;
    std::vector<std::byte> png;
};

/// What a page says beside the report.
struct VerifyPageFacts {
    std::string scene_path;
    std::string volume_path;
    /// "tetralight 0.1.0".
    std::string version;
    /// The command line that made the report.
    std::string command;
    VerifyLimits limits;
    /// Names and values, of the referee and of the bake.
    std::vector<std::pair<std::string, std::string>> settings;
    std::vector<VerifyPicture> pictures;
};

/// A report as one HTML page that needs no other file, no network and no script: the verdict first,
/// then charts, the worst probes and places, and how to repeat it. All texts are escaped.
[[nodiscard]] std::string verify_page(const VerifyReport& report, const VerifyPageFacts& facts);

}  // namespace tetralight
