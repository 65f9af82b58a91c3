// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <optional>

#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/failure.h>
#include <tetralight/cli/interrupt.h>
#include <tetralight/server/backup.h>

namespace tetralight::cli {
namespace {

using Copy = decltype(server::back_up);

/// "1 file is missing, 2 files are damaged".
std::string faults_text(const server::BackupReport& report) {
    const auto part = [](size_t count, const char* fault) {
        return str_cat(counted(count, "file"), count == 1 ? " is " : " are ", fault);
    };
    std::string text;
    if (!report.missing.empty()) text = part(report.missing.size(), "missing");
    if (report.damaged.empty()) return text;
    return text + (text.empty() ? "" : ", ") + part(report.damaged.size(), "damaged");
}

bool is_stream(const std::string& output) {
    std::error_code error;
    return output == "-" || std::filesystem::is_other(output, error);
}

Status run(const Values& values, std::string_view from, Copy copy) {
    const CommonOptions common(values);
    const std::string output = values.text("output");
    // To stdout or a pipe nothing is left to clean, and a write to it may wait for ever.
    std::optional<Interrupt> interrupt;
    if (!is_stream(output)) interrupt.emplace();
    const auto report = copy(values.text(from), output, [] { return Interrupt::signal() != 0; });
    if (!report) return report.error();
    const Json json{{"output", output},
                    {"files", report->files},
                    {"bytes", report->bytes},
                    {"missing", report->missing},
                    {"damaged", report->damaged}};
    common.warn(report->missing);
    common.warn(report->damaged);
    const std::string faults = faults_text(*report);
    if (!faults.empty()) {
        return with_report({ErrorCode::Corrupt, std::string(from), values.text(from),
                            str_cat(shown_path(output), ": is written, but ", faults)},
                           json);
    }
    common.report(output, json,
                  str_cat(printable(output), ": ", counted(report->files, "file"), ", ",
                          magnitude(static_cast<double>(report->bytes)), "B\n"));
    return Ok{};
}

}  // namespace

Status run_backup(const Values& values) {
    return run(values, "data", server::back_up);
}

Status run_restore(const Values& values) {
    return run(values, "archive", server::restore);
}

}  // namespace tetralight::cli
