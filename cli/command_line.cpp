// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/command_line.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>

#include <tetralight/base/str_cat.h>
#include <tetralight/settings/suggest.h>

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

/// The CLI11 parser of one command: it splits words and collects texts, and checks nothing.
class CommandParser {
  public:
    CommandParser(CLI::App& app, const Command& command) : command_(&command) {
        const std::string name(command.table->command);
        app_ = app.add_subcommand(name);
        app_->set_help_flag("");
        app_->allow_extras();
        help_ = app_->add_flag("-h,--help");
        command.table->for_each([&](const Setting& setting) { add(setting); });
    }

    [[nodiscard]] bool is_chosen() const { return app_->parsed(); }

    [[nodiscard]] Result<CommandLine> result() const {
        if (help_->count() > 0) return CommandLine{CommandLine::Kind::Help, command_};
        const auto unknown = app_->remaining();
        if (!unknown.empty()) return unknown_words(unknown);
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

  private:
    void add(const Setting& setting) {
        std::string name = shown_name(setting, Form::Options);
        if (setting.short_name != 0) name = str_cat("-", setting.short_name, ",") + name;
        CLI::Option* option =
            setting.type == Type::Flag ? app_->add_flag(name) : app_->add_option(name);
        option->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
        if (setting.type == Type::Numbers || setting.type == Type::Integers) {
            option->delimiter(',');
            option->expected(1, setting.count > 0 ? static_cast<int>(setting.count) : 1 << 20);
        } else if (setting.type != Type::Flag) {
            option->expected(setting.is_list && setting.is_positional ? -1 : 1);
        }
        options_[setting.name] = option;
    }

    /// "there is no option --sample; did you mean --samples?", in the order in which they were
    /// typed.
    [[nodiscard]] Error unknown_words(const std::vector<std::string>& words) const {
        std::vector<std::string> names{"--help"};
        command_->table->for_each([&](const Setting& setting) {
            if (!setting.is_positional) names.push_back(shown_name(setting, Form::Options));
        });
        std::string message, first;
        for (const std::string& word : words) {
            const std::string name = word.substr(0, word.find('='));
            if (!is_option(word)) continue;
            if (first.empty()) first = word;
            message += str_cat(message.empty() ? "" : "; ", "there is no option ", name,
                               settings::did_you_mean(name, names));
        }
        if (!message.empty()) return usage("", first, message);
        return usage("", words[0], str_cat("unexpected argument \"", words[0], "\""));
    }

    const Command* command_;
    CLI::App* app_ = nullptr;
    CLI::Option* help_ = nullptr;
    std::map<std::string_view, CLI::Option*> options_;
};

/// The whole program: its commands, and what it does itself.
class Parser {
  public:
    Parser() {
        app_.set_help_flag("");
        app_.allow_extras();
        help_ = app_.add_flag("-h,--help");
        version_ = app_.add_flag("--version");
        job_ = app_.add_option("--job")->expected(1);
        completion_ = app_.add_subcommand("completion");
        man_ = app_.add_subcommand("man");
        for (CLI::App* own : {completion_, man_}) {
            own->set_help_flag("");
            own->allow_extras();
        }
        for (const Command& command : commands()) parsers_.emplace_back(app_, command);
    }

    [[nodiscard]] Result<CommandLine> parse(int argc, const char* const* argv) {
        using Kind = CommandLine::Kind;
        try {
            app_.parse(argc, const_cast<char**>(argv));
        } catch (const CLI::ParseError&) {
            // Nothing is checked but that an option has a value, which only the last can lack.
            return missing_value(argv[argc - 1]);
        }
        if (help_->count() > 0) return CommandLine{Kind::Help};
        if (version_->count() > 0) return CommandLine{Kind::Version};
        if (job_->count() > 0) return CommandLine{.kind = Kind::Job, .word = job_->results()[0]};
        if (completion_->parsed()) return own_command(Kind::Completion, *completion_);
        if (man_->parsed()) return own_command(Kind::Man, *man_);
        for (const CommandParser& parser : parsers_) {
            if (parser.is_chosen()) return parser.result();
        }
        return unknown_command();
    }

  private:
    static CommandLine own_command(CommandLine::Kind kind, const CLI::App& app) {
        const auto words = app.remaining();
        return {.kind = kind, .word = words.empty() ? "" : words[0]};
    }

    [[nodiscard]] Error missing_value(const std::string& word) const {
        for (const CommandParser& parser : parsers_) {
            if (parser.is_chosen()) return parser.missing_value(word);
        }
        return usage("", word, word + " is given without a value");
    }

    [[nodiscard]] Error unknown_command() const {
        const auto words = app_.remaining();
        if (words.empty()) return usage("", "", "a subcommand is required");
        if (is_option(words[0])) {
            return usage("", words[0], "there is no option " + words[0]);
        }
        std::vector<std::string> names{"completion", "man"};
        for (const Command& command : commands()) names.emplace_back(command.table->command);
        return usage("", words[0],
                     str_cat("there is no subcommand \"", words[0], "\"",
                             settings::did_you_mean(words[0], names)));
    }

    CLI::App app_;
    CLI::Option* help_;
    CLI::Option* version_;
    CLI::Option* job_;
    CLI::App* completion_;
    CLI::App* man_;
    std::vector<CommandParser> parsers_;
};

}  // namespace

Result<CommandLine> parse_command_line(int argc, const char* const* argv) {
    return Parser().parse(argc, argv);
}

const Command* command_in(int argc, const char* const* argv) {
    return argc > 1 ? find_command(argv[1]) : nullptr;
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
