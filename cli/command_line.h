// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/cli/commands.h>
#include <tetralight/settings/read_values.h>

namespace tetralight::cli {

/// What the user asks for.
struct CommandLine {
    enum class Kind : uint8_t {
        Run,         ///< `command` with `arguments`
        Job,         ///< the job in the file `word`
        Help,        ///< of `command`, or of the program
        Version,     ///<
        Completion,  ///< for the shell `word`
        Man,         ///< the page of the command `word`, or of the program
    };

    Kind kind = Kind::Run;
    const Command* command = nullptr;
    std::vector<settings::Argument> arguments = {};
    std::string word = {};
};

/// Splits the words of the command line; the values of settings are not checked yet. The only
/// place that knows CLI11. Returns invalid_argument if an option or a command is unknown, or an
/// option has no value; `command_in` finds the command for the message.
[[nodiscard]] Result<CommandLine> parse_command_line(int argc, const char* const* argv);

/// The command that the words name; null: none. For messages about words that cannot be parsed.
[[nodiscard]] const Command* command_in(int argc, const char* const* argv);

/// True if the words ask for JSON. For messages about words that cannot be parsed.
[[nodiscard]] bool wants_json(int argc, const char* const* argv);

}  // namespace tetralight::cli
