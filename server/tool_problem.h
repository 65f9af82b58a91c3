// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/server/command.h>
#include <tetralight/server/problem.h>

namespace tetralight::server {

/// Why a command did not do what a request asked, in the words of the request: the files and
/// options that the command was given stand for members of its JSON, or for its body.
/// Precondition: the command did not end well.
[[nodiscard]] Problem tool_problem(const Settings& settings, const CommandResult& result,
                                   const Request& request);

/// What a command says, in the words of what it was asked with.
[[nodiscard]] std::string in_words_of(const Json& order, const std::string& message);

}  // namespace tetralight::server
