// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/failure.h>

#include <unistd.h>

#include <csignal>
#include <iostream>
#include <optional>

#include <tetralight/base/error_text.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/interrupt.h>

namespace tetralight::cli {
namespace {

/// Of this process, which runs one command.
Json g_report = Json::object();
bool g_has_checkpoint = false;
std::optional<std::vector<std::string>> g_warnings;

int exit_code_of(const Error& error) {
    const int signal = Interrupt::signal();
    if (error.code == ErrorCode::Cancelled && signal != 0) {
        const bool is_checkpoint =
            signal == SIGTERM && g_has_checkpoint && ::isatty(STDERR_FILENO) == 0;
        return is_checkpoint ? kExitTryAgain : kExitSignal + signal;
    }
    return can_retry(error.code) ? kExitTryAgain : kExitBadData;
}

void print_json(const Error& error, const FailureStyle& style) {
    Json json = std::move(g_report);
    json["error"] = error_json(error);
    (style.is_stdout_taken ? std::cerr : std::cout) << dump(with_warnings(json)) << std::endl;
}

}  // namespace

Json error_json(const Error& error) {
    return {{"code", error_code_name(error.code)},
            {"field", error.field},
            {"value", error.value},
            {"message", error_text(error)}};
}

int print_usage_error(const Error& error, const FailureStyle& style) {
    if (style.is_json) print_json(error, {});  // nothing was written to stdout yet
    const std::string name =
        style.command.empty() ? "tetralight" : str_cat("tetralight ", style.command);
    const std::string help =
        warnings_of_job() == nullptr ? str_cat(" (see ", name, " --help)") : std::string();
    std::cerr << name << ": " << printable(error_text(error)) << help << '\n';
    return kExitUsage;
}

int print_failure(const Error& error, const FailureStyle& style) {
    if (style.is_json) print_json(error, style);
    if (!style.is_json || !style.is_stdout_taken) {
        std::cerr << "tetralight: " << printable(error_text(error)) << '\n';
    }
    return exit_code_of(error);
}

Error with_report(Error error, Json report) {
    g_report = std::move(report);
    return error;
}

void note_checkpoint() {
    g_has_checkpoint = true;
}

void begin_job() {
    g_warnings.emplace();
}

std::vector<std::string>* warnings_of_job() {
    return g_warnings ? &*g_warnings : nullptr;
}

Json with_warnings(Json result) {
    if (g_warnings && !g_warnings->empty()) result["warnings"] = *g_warnings;
    return result;
}

}  // namespace tetralight::cli
