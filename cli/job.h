// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/base/result.h>
#include <tetralight/cli/commands.h>

namespace tetralight::cli {

/// A command and its settings, as one JSON object (docs/command.md).
struct Job {
    const Command* command;
    Values values;
};

/// Reads {"command": "bake", "scene": "s.glb", ...} from a file, - = stdin. The values have "json"
/// and "quiet" set. Returns invalid_argument about one member, and the errors of reading the file.
[[nodiscard]] Result<Job> read_job(const std::string& path);

}  // namespace tetralight::cli
