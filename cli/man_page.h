// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/base/result.h>

namespace tetralight::cli {

/// The manual page of a command, or of the program if `command` is empty, as roff text. Returns
/// invalid_argument if there is no such command.
[[nodiscard]] Result<std::string> man_page(const std::string& command);

}  // namespace tetralight::cli
