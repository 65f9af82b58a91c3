// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>

namespace tetralight::cli {

/// An option whose value is one of a few words.
template <class Enum>
CLI::Option* add_choice(CLI::App& command, const std::string& name, Enum& value,
                        const std::map<std::string, Enum>& words, const std::string& help) {
    const auto take = [&value, words](const std::string& word) { value = words.at(word); };
    auto* option = command.add_option_function<std::string>(name, take, help);
    option->check(CLI::IsMember(words));
    for (const auto& [word, meaning] : words) {
        if (meaning == value) option->default_str(word);
    }
    return option;
}

}  // namespace tetralight::cli
