// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <tetralight/base/result.h>

// The files that a command reads and writes.

namespace tetralight::cli {

/// True if two paths name the same file, which need not exist.
[[nodiscard]] bool is_same_file(const std::string& a, const std::string& b);

/// Finds out before a long job that the output cannot be written, or that it would replace one of
/// the inputs. `-` is stdout.
[[nodiscard]] Status check_output(const std::string& path, const std::vector<std::string>& inputs);

}  // namespace tetralight::cli
