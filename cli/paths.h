// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include <tetralight/base/result.h>

// The files that a command reads and writes, as options.

namespace tetralight::cli {

/// An option whose value is a path; an empty one is wrong usage.
CLI::Option* add_path(CLI::App& command, const std::string& name, std::string& path,
                      const std::string& help);

/// The same for several paths.
CLI::Option* add_paths(CLI::App& command, const std::string& name, std::vector<std::string>& paths,
                       const std::string& help);

/// An option for a file to write. It may have no extension, or this one (or one of several with
/// commas between): nobody wants a PNG that is called picture.jpg, or loses a scene to a slip of
/// the hand.
CLI::Option* add_file_to_write(CLI::App& command, const std::string& name, std::string& path,
                               const std::string& extension, const std::string& help);

/// `-o`: the file that the command is there to write, of the same rule.
CLI::Option* add_output(CLI::App& command, std::string& path, const std::string& extension,
                        const std::string& help);

/// Whether two paths lead to one file, be it there or not.
[[nodiscard]] bool is_same_file(const std::string& a, const std::string& b);

/// Says before a long job, not after it, that the output cannot be written, or that it would take
/// the place of one of the inputs. `-` is stdout.
[[nodiscard]] Status check_output(const std::string& path, const std::vector<std::string>& inputs);

}  // namespace tetralight::cli
