// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <tetralight/base/result.h>

// The files that a command reads and writes.

namespace tetralight::cli {

/// True if two paths name the same file, which need not exist.
[[nodiscard]] bool is_same_file(const std::string& a, const std::string& b);

/// Finds out before a long job that an output cannot be written, or that it would replace one of
/// the inputs. `-` is stdout. `setting` names the output in errors: invalid_argument, not_found for
/// a folder that is not there, unavailable without permission.
[[nodiscard]] Status check_output(const std::string& path, const std::vector<std::string>& inputs,
                                  const std::string& setting = "output");

/// The same for a file beside the output that is replaced while the command runs. It may be none of
/// the `others`, whether they exist or not.
[[nodiscard]] Status check_side_file(const std::string& path,
                                     const std::vector<std::string>& others,
                                     const std::string& setting);

/// Makes a folder and those above it, where they are not there. The error names the setting.
[[nodiscard]] Status make_folder(const std::string& path, const std::string& setting);

}  // namespace tetralight::cli
