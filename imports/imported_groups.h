// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <tetralight/probes/probe_group.h>

namespace tetralight {

/// The probe groups of a file.
struct ImportedGroups {
    std::vector<ProbeGroup> groups;
    /// What was left out, and why. Each begins with the path of the file.
    std::vector<std::string> warnings;
};

}  // namespace tetralight
