// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <tetralight/server/json.h>
#include <tetralight/server/settings.h>

// All work that takes long, or reads what strangers sent, is done by the `tetralight` command in a
// process of its own: what ends that process ends a request or a bake, and never the server.

namespace tetralight::server {

struct Command {
    /// Without the program: "render", "scene.glb", ...
    std::vector<std::string> arguments;
    /// The folder to work in; arguments name files of it.
    std::string folder;
    /// After so many seconds it is ended; 0 = never.
    double limit_seconds = 0.0;
    /// Nobody waits for it: it takes what the processors have left.
    bool is_background = false;
    /// Called a few times a second on the calling thread; false ends the command.
    std::function<bool()> goes_on = {};
};

struct CommandResult {
    enum class End : uint8_t {
        Fine,
        BadData,   ///< exit code 1: `message` says what is wrong
        BadUsage,  ///< exit code 2
        Stopped,   ///< because `goes_on` said so
        TooSlow,
        Crashed,  ///< by a signal, or it could not be run: `message` says how
    };

    End end = End::Crashed;
    /// What it printed as JSON.
    Json report;
    /// Of its errors the last; of its warnings each.
    std::string message = {};
    std::vector<std::string> warnings = {};
};

/// Runs a command in its folder, with less priority than queries, and waits for its end. It dies
/// with the calling thread.
[[nodiscard]] CommandResult run_command(const Settings& settings, const Command& command);

/// What it reported, without the files of its folder, with its warnings. Precondition: it ended
/// well.
[[nodiscard]] Json report_of(CommandResult result);

/// The report of a command for the server itself. Throws a `Problem` unless it ends well.
Json run_or_throw(const Settings& settings, const Command& command);

/// The program to run: that of the settings, or this one.
[[nodiscard]] std::string program_of(const Settings& settings);

}  // namespace tetralight::server
