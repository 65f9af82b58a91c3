// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/base/result.h>

namespace tetralight::cli {

/// The script by which a shell ("bash", "zsh") completes commands, options, choices and files.
/// Returns invalid_argument for any other shell.
[[nodiscard]] Result<std::string> completion_script(const std::string& shell);

}  // namespace tetralight::cli
