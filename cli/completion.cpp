// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/completion.h>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/commands.h>

namespace tetralight::cli {
namespace {

using settings::Form;
using settings::Setting;
using settings::Table;
using settings::Type;

std::string names_of_commands() {
    std::string names;
    for (const Command& command : commands()) names += str_cat(command.table->command, " ");
    return names + "completion man";
}

std::string options_of(const Table& table) {
    std::string names = "--help";
    table.for_each([&](const Setting& setting) {
        if (!setting.is_positional) names += " " + shown_name(setting, Form::Options);
    });
    return names;
}

/// "--output|-o": the words before a value.
std::string option_pattern(const Setting& setting) {
    const std::string name = shown_name(setting, Form::Options);
    return setting.short_name == 0 ? name : str_cat(name, "|-", setting.short_name);
}

bool is_folder(const Setting& setting) {
    return setting.value_name == "FOLDER" || setting.value_name == "DIR";
}

/// One branch of a `case` over "COMMAND OPTION" for each option whose values are known, and one for
/// options whose value is something else.
std::string bash_values(const Table& table) {
    std::string text;
    table.for_each([&](const Setting& setting) {
        if (setting.is_positional || setting.type == Type::Flag) return;
        std::string action = "return";
        if (setting.type == Type::Choice) {
            action =
                str_cat("COMPREPLY=($(compgen -W '", setting.choices, "' -- \"$word\")); return");
        } else if (is_folder(setting)) {
            action = "mapfile -t COMPREPLY < <(compgen -d -- \"$word\"); return";
        } else if (setting.type == Type::Path || setting.type == Type::Sky) {
            action = "mapfile -t COMPREPLY < <(compgen -f -- \"$word\"); return";
        }
        text += str_cat("            ", option_pattern(setting), ") ", action, " ;;\n");
    });
    return text;
}

std::string bash_script() {
    std::string text = str_cat(
        "# bash completion of tetralight, made by `tetralight completion bash`\n"
        "_tetralight() {\n"
        "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
        "    COMPREPLY=()\n"
        "    # --option=value is three words here\n"
        "    if [ \"$word\" = = ]; then word=''\n"
        "    elif [ \"$before\" = = ]; then before=${COMP_WORDS[COMP_CWORD-2]}; fi\n"
        "    if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
        "        COMPREPLY=($(compgen -W '",
        names_of_commands(),
        " --help --job --version' -- \"$word\"))\n"
        "        return\n"
        "    fi\n"
        "    local options=''\n"
        "    case ${COMP_WORDS[1]} in\n");
    for (const Command& command : commands()) {
        const Table& table = *command.table;
        text += str_cat("    ", table.command, ")\n        options='", options_of(table),
                        "'\n        case $before in\n", bash_values(table), "        esac ;;\n");
    }
    text +=
        str_cat("    completion) COMPREPLY=($(compgen -W 'bash zsh' -- \"$word\")); return ;;\n",
                "    man) COMPREPLY=($(compgen -W '", names_of_commands(),
                "' -- \"$word\")); return ;;\n    esac\n",
                "    case $word in\n"
                "    -*) COMPREPLY=($(compgen -W \"$options\" -- \"$word\")) ;;\n"
                "    *) mapfile -t COMPREPLY < <(compgen -f -- \"$word\") ;;\n"
                "    esac\n"
                "}\n"
                "complete -o filenames -F _tetralight tetralight\n");
    return text;
}

/// Text within '...' and, in a specification of _arguments, within [...].
std::string zsh_text(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '\'') {
            escaped += "'\\''";
        } else if (c == '[' || c == ']' || c == ':' || c == '\\') {
            escaped += str_cat("\\", c);
        } else {
            escaped += c;
        }
    }
    return escaped;
}

std::string zsh_action(const Setting& setting) {
    switch (setting.type) {
        case Type::Flag:
            return "";
        case Type::Choice:
            return str_cat(":value:(", setting.choices, ")");
        case Type::Path:
        case Type::Sky:
            return is_folder(setting) ? ":folder:_files -/" : ":file:_files";
        default:
            return str_cat(":", zsh_text(value_name(setting)), ":");
    }
}

std::string zsh_arguments(const Table& table) {
    std::string text = "_arguments '--help[Print the help]'";
    table.for_each([&](const Setting& setting) {
        if (setting.is_positional) return;
        const std::string many = setting.is_list ? "*" : "";
        const std::string equals = setting.type == Type::Flag ? "" : "=";
        text += str_cat(" \\\n            '", many, shown_name(setting, Form::Options), equals, "[",
                        zsh_text(setting.help), "]", zsh_action(setting), "'");
    });
    return text + " \\\n            '*:file:_files'";
}

std::string zsh_script() {
    std::string text =
        "#compdef tetralight\n"
        "# zsh completion of tetralight, made by `tetralight completion zsh`\n"
        "_tetralight() {\n"
        "    local -a commands\n"
        "    commands=(\n";
    for (const Command& command : commands()) {
        text += str_cat("        '", command.table->command, ":", zsh_text(command.table->summary),
                        "'\n");
    }
    text +=
        "        'completion:Print the completion script of a shell'\n"
        "        'man:Print a manual page'\n"
        "    )\n"
        "    if [[ $words[2] == -* ]]; then\n"
        "        _arguments '--help[Print the help]' '--version[Print the version]' \\\n"
        "            '--job=[Run the command that a JSON object describes]:file:_files'\n"
        "        return\n"
        "    fi\n"
        "    if (( CURRENT == 2 )); then\n"
        "        _describe command commands\n"
        "        return\n"
        "    fi\n"
        "    local verb=$words[2]\n"
        "    shift words\n"
        "    (( CURRENT-- ))\n"
        "    case $verb in\n";
    for (const Command& command : commands()) {
        text += str_cat("        ", command.table->command, ") ", zsh_arguments(*command.table),
                        " ;;\n");
    }
    text += str_cat("        completion) _values shell bash zsh ;;\n        man) _values command ",
                    names_of_commands(),
                    " ;;\n    esac\n}\n"
                    "if [ \"$funcstack[1]\" = _tetralight ]; then _tetralight \"$@\"; else compdef "
                    "_tetralight tetralight; fi\n");
    return text;
}

}  // namespace

Result<std::string> completion_script(const std::string& shell) {
    if (shell == "bash") return bash_script();
    if (shell == "zsh") return zsh_script();
    return Error{ErrorCode::InvalidArgument, "shell", shell,
                 "completion: give bash or zsh, not \"" + shell + "\""};
}

}  // namespace tetralight::cli
