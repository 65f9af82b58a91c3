// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/help.h>

#include <algorithm>
#include <cmath>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/table.h>

namespace tetralight::cli {
namespace {

using settings::Setting;
using settings::Table;
using settings::Type;

constexpr size_t kHelpColumn = 30;

/// "  NAME      help", below each other.
void append_row(std::string& text, const std::string& name, const std::string& help) {
    text += "  " + name;
    const size_t used = name.size() + 2;
    text += used + 2 > kHelpColumn ? "\n" + std::string(kHelpColumn, ' ')
                                   : std::string(kHelpColumn - used, ' ');
    append_wrapped(text, help, kHelpColumn);
}

void append_part(std::string& text, const std::string& part) {
    if (!part.empty()) text += (text.empty() ? "" : "; ") + part;
}

/// Limits that only keep numbers finite are no news for people.
std::string limits_text(const Setting& setting) {
    constexpr double kFar = 1e9;
    settings::Range range = setting.range;
    const bool is_scalar = setting.type == Type::Fraction || setting.type == Type::Seconds;
    if (is_scalar) return "";
    if (std::abs(range.max) >= kFar) range.max = HUGE_VAL;
    if (std::abs(range.min) >= kFar) range.min = -HUGE_VAL;
    return range_text(range);
}

std::string extensions_text(const Setting& setting) {
    std::string words(setting.extensions);
    std::string list;
    settings::for_each_word(
        words, [&](std::string_view word) { list += str_cat(list.empty() ? "" : ", ", word); });
    return list;
}

}  // namespace

std::string option_text(const Setting& setting) {
    const std::string name = shown_name(setting, settings::Form::Options);
    if (setting.is_positional) return name + (setting.is_list ? "..." : "");
    const std::string letter =
        setting.short_name == 0 ? "" : str_cat("-", setting.short_name, ", ");
    const std::string value = value_name(setting);
    return letter + name + (value.empty() ? "" : " " + value);
}

std::string details_text(const Setting& setting) {
    std::string text;
    append_part(text, setting.is_required ? "required" : "");
    append_part(text, setting.unit == "seed" ? "" : std::string(setting.unit));
    append_part(text, limits_text(setting));
    append_part(text, extensions_text(setting));
    if (setting.is_list) append_part(text, "may be given several times");
    if (!setting.default_text.empty())
        append_part(text, str_cat("default: ", setting.default_text));
    if (!setting.without.empty()) append_part(text, str_cat("default: ", setting.without));
    return text;
}

std::string usage_text(const Table& table) {
    std::string text = str_cat(table.command, " [OPTIONS]");
    table.for_each([&](const Setting& setting) {
        if (!setting.is_positional) {
            if (setting.is_required) text += " " + option_text(setting);
            return;
        }
        text +=
            setting.is_required ? " " + option_text(setting) : " [" + option_text(setting) + "]";
    });
    return text;
}

std::string help_text(const Table& table) {
    std::string text = str_cat(table.summary, "\nUsage: tetralight ", usage_text(table), "\n");
    for (const settings::Group& group : table.groups) {
        text += str_cat("\n", group.heading, ":\n");
        for (const Setting& setting : group.settings) {
            const std::string details = details_text(setting);
            append_row(text, option_text(setting),
                       str_cat(setting.help, details.empty() ? "" : " [" + details + "]"));
        }
        if (&group == &table.groups.back()) append_row(text, "-h, --help", "Print this help");
    }
    text += "\nExample:\n";
    for (std::string_view rest = table.examples; !rest.empty();) {
        const size_t end = std::min(rest.find('\n'), rest.size());
        text += str_cat("  ", rest.substr(0, end), "\n");
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return text;
}

const char* program_summary() {
    return "Baked light probes for things that move: bake a glTF scene, query and render it";
}

std::string program_help_text() {
    std::string text = str_cat(program_summary(), "\nUsage: tetralight COMMAND [OPTIONS]\n",
                               "       tetralight --job FILE\n\nCommands:\n");
    const auto add = [&](std::string_view name, std::string_view summary) {
        append_row(text, std::string(name), std::string(summary));
    };
    for (const Command& command : commands()) add(command.table->command, command.table->summary);
    add("completion", "Print the completion script for bash or zsh");
    add("man", "Print the manual page of a command, or of the program");
    text += "\nOptions:\n";
    add("--job FILE", "Run the command that a JSON file describes (- = stdin)");
    add("--version", "Print the version");
    add("-h, --help", "Print this help; tetralight COMMAND --help has the options of a command");
    return text;
}

}  // namespace tetralight::cli
