// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <tetralight/settings/values.h>

// One report of a bake of many scenes, for people (JSON) and for build servers (JUnit).

namespace tetralight {

/// A file that was baked.
struct BatchFile {
    std::string kind;  ///< "probes", "lightmaps" or "reflections"
    std::string name;  ///< "hall.probes"
    uint64_t bytes = 0;
    double seconds = 0.0;
    settings::Json report;  ///< of the command that wrote it
    settings::Json leaks;   ///< of `check-leaks`; null: not measured
};

struct BatchScene {
    std::string name;
    settings::Json limits;  ///< numbers by the names of `settings::kLimits`
    std::vector<BatchFile> files;
    std::string error = {};  ///< why there is no light; empty: there is
};

/// {"passed", "scenes": [{"name", "passed", "seconds", "rays", "limits", "files"}]}. `limits` has
/// for each limit its name, value and limit, and whether it is kept: a value that is not known
/// (null) does not keep it. A scene with an error has not passed.
[[nodiscard]] settings::Json batch_report(std::span<const BatchScene> scenes);

/// The report as JUnit has it: a suite for each scene, a test for each file and each limit.
[[nodiscard]] std::string junit_text(const settings::Json& report);

/// "hall: error of probes is 0.023, more than 0.02": what is not kept, one a line.
[[nodiscard]] std::string failed_limits(const settings::Json& report);

}  // namespace tetralight
