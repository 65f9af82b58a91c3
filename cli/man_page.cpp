// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/man_page.h>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/help.h>

namespace tetralight::cli {
namespace {

using settings::Setting;
using settings::Table;

/// Text that roff prints as it is: no control line, minus signs instead of hyphens.
std::string roff(std::string_view text) {
    std::string escaped = text.starts_with('.') || text.starts_with('\'') ? "\\&" : "";
    for (const char c : text) {
        if (c == '\\') {
            escaped += "\\e";
        } else if (c == '-') {
            escaped += "\\-";
        } else {
            escaped += c;
        }
    }
    return escaped;
}

std::string heading(const std::string& page, std::string_view summary) {
    std::string title = page;
    for (char& c : title) {
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    }
    return str_cat(".TH ", roff(title), " 1 \"\" \"Tetralight ", TETRALIGHT_VERSION,
                   "\" \"User Commands\"\n.SH NAME\n", roff(page), " \\- ", roff(summary), "\n");
}

void append_entry(std::string& text, std::string_view name, std::string_view help) {
    text += str_cat(".TP\n.B ", roff(name), "\n", roff(help), "\n");
}

constexpr const char* kExitStatus =
    ".SH EXIT STATUS\n"
    ".TP\n.B 0\nsuccess\n"
    ".TP\n.B 1\nthe data, or a setting that does not fit the data, are wrong\n"
    ".TP\n.B 2\nwrong usage\n"
    ".TP\n.B 75\ntry again: a file is out of reach, memory or disk is used up, or an interrupted "
    "bake kept its work\n"
    ".TP\n.B 130, 143\ninterrupted by SIGINT or SIGTERM\n";

std::string program_page() {
    std::string text = heading("tetralight", program_summary());
    text +=
        ".SH SYNOPSIS\n.B tetralight\nCOMMAND [OPTIONS]\n.br\n.B tetralight \\-\\-job\nFILE\n"
        ".SH COMMANDS\n";
    for (const Command& command : commands()) {
        append_entry(
            text, command.table->command,
            str_cat(command.table->summary, "; see tetralight-", command.table->command, "(1)"));
    }
    append_entry(text, "completion bash|zsh", "Print the completion script of a shell");
    append_entry(text, "man [COMMAND]", "Print a manual page");
    text += ".SH OPTIONS\n";
    append_entry(text, "--job FILE",
                 "Run the command that a JSON object describes: its members are \"command\" and "
                 "the options with underscores for dashes (- = stdin)");
    append_entry(text, "--version", "Print the version");
    return text + kExitStatus;
}

std::string command_page(const Table& table) {
    std::string text = heading(str_cat("tetralight-", table.command), table.summary);
    text += str_cat(".SH SYNOPSIS\n.B tetralight\n", roff(usage_text(table)), "\n");
    for (const settings::Group& group : table.groups) {
        text += str_cat(".SH ", roff(group.heading), "\n");
        for (const Setting& setting : group.settings) {
            const std::string details = details_text(setting);
            append_entry(text, option_text(setting),
                         str_cat(setting.help, details.empty() ? "" : " [" + details + "]"));
        }
    }
    text += str_cat(".SH EXAMPLES\n.nf\n", roff(table.examples), "\n.fi\n");
    return text + kExitStatus + ".SH SEE ALSO\n.BR tetralight (1)\n";
}

}  // namespace

Result<std::string> man_page(const std::string& command) {
    if (command.empty()) return program_page();
    const Command* found = find_command(command);
    if (found != nullptr) return command_page(*found->table);
    return Error{ErrorCode::InvalidArgument, "command", command,
                 "there is no command \"" + command + "\""};
}

}  // namespace tetralight::cli
