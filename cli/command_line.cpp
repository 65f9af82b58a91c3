// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/command_line.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <map>
#include <utility>

#include <tetralight/base/str_cat.h>
#include <tetralight/base/suggest.h>

namespace tetralight::cli {
namespace {

using settings::Form;
using settings::Setting;
using settings::Table;
using settings::Type;

bool is_option(const std::string& word) {
    return word.size() > 1 && word[0] == '-';
}

Error usage(std::string_view field, std::string_view value, const std::string& message) {
    return {ErrorCode::InvalidArgument, std::string(field), std::string(value), message};
}

Error unexpected(const std::string& word) {
    return usage("", word, str_cat("unexpected argument \"", word, "\""));
}

/// "there is no option -1; write several numbers as 0,-1,0" after `--sun-direction 0 -1 0`.
bool is_number(const std::string& word) {
    double number = 0.0;
    const char* end = word.data() + word.size();
    return std::from_chars(word.data(), end, number).ptr == end;
}

/// The CLI11 parser of one command: it splits words and collects texts, and checks nothing.
class CommandParser {
  public:
    explicit CommandParser(const Command& command) : command_(&command) {
        app_.set_help_flag("");
        app_.allow_extras();
        command.table->for_each([&](const Setting& setting) { add(setting); });
    }

    [[nodiscard]] Result<CommandLine> parse(const std::vector<std::string>& words) {
        const auto end = std::ranges::find(words, "--");
        for (auto word = words.begin(); word != end; ++word) {
            if (*word == "-h" || *word == "--help") {
                return CommandLine{CommandLine::Kind::Help, command_};
            }
            if (is_long_option_with_one_hyphen(*word)) return unknown_words({*word});
        }
        try {
            app_.parse(std::vector<std::string>(words.rbegin(), words.rend()));
        } catch (const CLI::ParseError&) {
            // Nothing is checked but that an option has a value, which only the last can lack.
            return missing_value(words.back());
        }
        std::vector<std::string> unknown = app_.remaining();
        std::erase(unknown, "--");
        if (!unknown.empty()) return unknown_words(unknown);
        return collected();
    }

  private:
    void add(const Setting& setting) {
        std::string name = shown_name(setting, Form::Options);
        if (!setting.is_positional) option_names_.push_back(name);
        if (setting.short_name != 0) name = str_cat("-", setting.short_name, ",") + name;
        CLI::Option* option =
            setting.type == Type::Flag ? app_.add_flag(name) : app_.add_option(name);
        option->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
        if (setting.type == Type::Numbers || setting.type == Type::Integers) {
            option->delimiter(',');
            option->expected(1, setting.count > 0 ? static_cast<int>(setting.count) : 1 << 20);
        } else if (setting.type != Type::Flag) {
            option->expected(setting.is_list && setting.is_positional ? -1 : 1);
        }
        options_[setting.name] = option;
    }

    [[nodiscard]] CommandLine collected() const {
        CommandLine line{CommandLine::Kind::Run, command_};
        command_->table->for_each([&](const Setting& setting) {
            const auto& texts = options_.at(setting.name)->results();
            const bool is_one = setting.type == Type::Numbers || setting.type == Type::Integers;
            if (is_one && !texts.empty()) {
                line.arguments.push_back({&setting, CLI::detail::join(texts, ",")});
            } else if (setting.type == Type::Flag && !texts.empty()) {
                line.arguments.push_back({&setting, texts.back()});
            } else {
                for (const auto& text : texts) line.arguments.push_back({&setting, text});
            }
        });
        return line;
    }

    /// "-samples", which would be read as "-s amples".
    [[nodiscard]] bool is_long_option_with_one_hyphen(const std::string& word) const {
        return std::ranges::find(option_names_, "-" + word) != option_names_.end();
    }

    /// About the last word, an option that wants a value.
    [[nodiscard]] Error missing_value(const std::string& word) const {
        const Setting* found = nullptr;
        command_->table->for_each([&](const Setting& setting) {
            const bool is_short = setting.short_name != 0 && word.size() > 1 && word[1] != '-' &&
                                  word.back() == setting.short_name;
            if (is_short || shown_name(setting, Form::Options) == word.substr(0, word.find('='))) {
                found = &setting;
            }
        });
        if (found == nullptr) return usage("", word, word + " is given without a value");
        return usage(found->name, "",
                     shown_name(*found, Form::Options) + " is given without a value");
    }

    /// "there is no option --sample; did you mean --samples?", in the order in which they were
    /// typed.
    [[nodiscard]] Error unknown_words(const std::vector<std::string>& words) const {
        std::vector<std::string> names = option_names_;
        names.emplace_back("--help");
        std::string message, first;
        for (const std::string& word : words) {
            const std::string name = word.substr(0, word.find('='));
            if (!is_option(word)) continue;
            if (first.empty()) first = word;
            const std::string hint = is_number(word) ? "; several numbers are written 0,-1,0"
                                                     : did_you_mean(name, names);
            if (!message.empty()) message += message.back() == '?' ? " " : "; ";
            message += str_cat("there is no option ", name, hint);
        }
        if (!message.empty()) return usage("", first, message);
        return unexpected(words[0]);
    }

    CLI::App app_;
    const Command* command_;
    std::map<std::string_view, CLI::Option*> options_;
    std::vector<std::string> option_names_;
};

/// Words that name what the program does, beside its commands.
constexpr std::pair<std::string_view, CommandLine::Kind> kOwnCommands[] = {
    {"completion", CommandLine::Kind::Completion},
    {"man", CommandLine::Kind::Man},
    {"help", CommandLine::Kind::Help}};

/// The index of the first word that is not an option. Only this word selects the command.
size_t command_index(const std::vector<std::string>& words) {
    size_t index = 0;
    while (index < words.size() && is_option(words[index]))
        index += words[index] == "--job" ? 2 : 1;
    return std::min(index, words.size());
}

Error unknown_command(const std::string& word) {
    std::vector<std::string> names;
    for (const auto& [name, kind] : kOwnCommands) names.emplace_back(name);
    for (const Command& command : commands()) names.emplace_back(command.table->command);
    return usage("", word,
                 str_cat("there is no command \"", word, "\"", did_you_mean(word, names)));
}

/// Options of the program: words without a command.
Result<CommandLine> parse_options(const std::vector<std::string>& words) {
    using Kind = CommandLine::Kind;
    if (words.empty()) return usage("", "", "a command is required");
    const std::string& word = words[0];
    if (word == "-h" || word == "--help") return CommandLine{Kind::Help};
    if (word == "--version") return CommandLine{Kind::Version};
    const bool is_joined = word.starts_with("--job=");
    if (word != "--job" && !is_joined) {
        const std::vector<std::string> names{"--help", "--version", "--job"};
        return usage("", word, str_cat("there is no option ", word, did_you_mean(word, names)));
    }
    const size_t count = is_joined ? 1 : 2;
    if (words.size() < count) return usage("", word, "--job is given without a value");
    if (words.size() > count) return unexpected(words[count]);
    return CommandLine{.kind = Kind::Job, .word = is_joined ? word.substr(6) : words[1]};
}

/// `completion SHELL`, `man [COMMAND]`, `help [COMMAND]`.
Result<CommandLine> parse_own_command(CommandLine::Kind kind,
                                      const std::vector<std::string>& words) {
    using Kind = CommandLine::Kind;
    const std::string word = words.empty() ? "" : words[0];
    if (word == "-h" || word == "--help") return CommandLine{Kind::Help};
    if (words.size() > 1) return unexpected(words[1]);
    if (kind != Kind::Help || word.empty()) return CommandLine{.kind = kind, .word = word};
    const Command* command = find_command(word);
    if (command == nullptr) return unknown_command(word);
    return CommandLine{Kind::Help, command};
}

std::vector<std::string> words_of(int argc, const char* const* argv) {
    return {argv + std::min(argc, 1), argv + argc};
}

}  // namespace

Result<CommandLine> parse_command_line(int argc, const char* const* argv) {
    std::vector<std::string> words = words_of(argc, argv);
    const size_t index = command_index(words);
    const bool has_job = std::ranges::any_of(
        words.begin(), words.begin() + static_cast<std::ptrdiff_t>(index),
        [](const std::string& word) { return word == "--job" || word.starts_with("--job="); });
    if (index == words.size() || has_job) return parse_options(words);
    const std::string name = words[index];
    words.erase(words.begin() + static_cast<std::ptrdiff_t>(index));
    for (const auto& [own, kind] : kOwnCommands) {
        if (name == own) return parse_own_command(kind, words);
    }
    const Command* command = find_command(name);
    return command == nullptr ? unknown_command(name) : CommandParser(*command).parse(words);
}

const Command* command_in(int argc, const char* const* argv) {
    const std::vector<std::string> words = words_of(argc, argv);
    const size_t index = command_index(words);
    return index < words.size() ? find_command(words[index]) : nullptr;
}

bool wants_json(int argc, const char* const* argv) {
    for (int i = 1; i < argc; ++i) {
        const std::string_view word = argv[i];
        if (word == "--") return false;
        if (word == "--json" || word == "--job" || word.starts_with("--job=")) return true;
    }
    return false;
}

}  // namespace tetralight::cli
