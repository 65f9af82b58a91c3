// SPDX-License-Identifier: Apache-2.0
// The `tetralight` command. Its exit codes: docs/command.md.
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <iostream>
#include <new>

#include <tetralight/base/str_cat.h>
#include <tetralight/base/system_error.h>
#include <tetralight/cli/command_line.h>
#include <tetralight/cli/completion.h>
#include <tetralight/cli/failure.h>
#include <tetralight/cli/help.h>
#include <tetralight/cli/job.h>
#include <tetralight/cli/man_page.h>

namespace tetralight::cli {
namespace {

/// True if the data that the command writes go to stdout.
bool takes_stdout(const Values& values) {
    bool found = false;
    values.table().for_each([&](const settings::Setting& setting) {
        const bool is_written = !setting.extensions.empty() || setting.name == "output";
        found = found || (is_written && values.text(setting.name) == "-");
    });
    return found;
}

/// Names the setting in an error about a file that a setting names.
Error with_setting(Error error, const Values& values) {
    if (!error.field.empty() || error.value.empty()) return error;
    values.table().for_each([&](const settings::Setting& setting) {
        if (setting.type != settings::Type::Path && setting.type != settings::Type::Sky) return;
        const settings::Json* value = values.find(setting.name);
        if (value == nullptr) return;
        const bool is_in_list =
            value->is_array() && std::ranges::find(*value, Json(error.value)) != value->end();
        if (is_in_list || *value == Json(error.value)) error.field = setting.name;
    });
    return error;
}

/// The system's reason is that of the last call, if it was kept.
Error stdout_error() {
    const int number = errno;
    if (number == 0) return {ErrorCode::Unavailable, "output", "-", "cannot write to stdout"};
    Error error = system_error("stdout", "write");
    error.field = "output";
    error.value = "-";
    return error;
}

int run(const Command& command, const Values& values) {
    const FailureStyle style{
        .is_json = command.table->find("json") != nullptr && values.flag("json"),
        .is_stdout_taken = takes_stdout(values),
        .command = command.table->command};
    try {
        const Status status = command.run(values);
        if (!status) return print_failure(with_setting(status.error(), values), style);
        errno = 0;
        std::cout.flush();
        if (std::cout) return kExitFine;
        return print_failure(stdout_error(), {.is_json = style.is_json, .is_stdout_taken = true});
    } catch (const UsageError& usage) {
        return print_usage_error(usage.error, style);
    } catch (const std::bad_alloc&) {
        return print_failure({ErrorCode::OutOfResources, "not enough memory"}, style);
    }
}

int run_job(const std::string& path) {
    begin_job();
    const auto job = read_job(path);
    const FailureStyle style{.is_json = true};
    if (job) return run(*job->command, job->values);
    return job.error().code == ErrorCode::InvalidArgument ? print_usage_error(job.error(), style)
                                                          : print_failure(job.error(), style);
}

int print_text(const Result<std::string>& text, const FailureStyle& style) {
    if (!text) return print_usage_error(text.error(), style);
    errno = 0;
    std::cout << *text << std::flush;
    return std::cout ? kExitFine : print_failure(stdout_error(), {.is_stdout_taken = true});
}

int run_line(const CommandLine& line, const FailureStyle& style) {
    switch (line.kind) {
        case CommandLine::Kind::Job:
            return run_job(line.word);
        case CommandLine::Kind::Help:
            return print_text(line.command ? help_text(*line.command->table) : program_help_text(),
                              style);
        case CommandLine::Kind::Version:
            return print_text(std::string("tetralight " TETRALIGHT_VERSION "\n"), style);
        case CommandLine::Kind::Completion:
            return print_text(completion_script(line.word), style);
        case CommandLine::Kind::Man:
            return print_text(man_page(line.word), style);
        case CommandLine::Kind::Run:
            break;
    }
    const auto values = settings::values_from_arguments(*line.command->table, line.arguments);
    return values ? run(*line.command, *values) : print_usage_error(values.error(), style);
}

int main_program(int argc, char** argv) {
    FailureStyle style{.is_json = wants_json(argc, argv)};
    if (const Command* command = command_in(argc, argv)) style.command = command->table->command;
    const auto line = parse_command_line(argc, argv);
    return line ? run_line(*line, style) : print_usage_error(line.error(), style);
}

}  // namespace
}  // namespace tetralight::cli

int main(int argc, char** argv) {
    std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is an error like any other
    return tetralight::cli::main_program(argc, argv);
}
