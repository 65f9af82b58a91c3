// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/settings/setting.h>

// What --help prints, made of the tables of settings.

namespace tetralight::cli {

[[nodiscard]] std::string help_text(const settings::Table& table);

/// Of the program: its commands.
[[nodiscard]] std::string program_help_text();

/// One sentence for people who do not know the program.
[[nodiscard]] const char* program_summary();

/// "bake [OPTIONS] SCENE".
[[nodiscard]] std::string usage_text(const settings::Table& table);

/// "-o, --output FILE", "SCENE".
[[nodiscard]] std::string option_text(const settings::Setting& setting);

/// What follows the help of a setting: "metres, 0 to 1; default: 0.75".
[[nodiscard]] std::string details_text(const settings::Setting& setting);

}  // namespace tetralight::cli
