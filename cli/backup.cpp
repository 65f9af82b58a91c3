// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/common.h>
#include <tetralight/server/backup.h>

namespace tetralight::cli {
namespace {

void report_backup(const CommonOptions& common, const std::string& output,
                   const server::BackupReport& report) {
    const Json json{{"output", output},
                    {"files", report.files},
                    {"bytes", report.bytes},
                    {"missing", report.missing}};
    common.warn(report.missing);
    common.report(output, json,
                  str_cat(printable(output), ": ", counted(report.files, "file"), ", ",
                          magnitude(static_cast<double>(report.bytes)), "B\n"));
}

}  // namespace

Status run_backup(const Values& values) {
    const CommonOptions common(values);
    const std::string output = values.text("output");
    const auto report = server::back_up(values.text("data"), output);
    if (!report) return report.error();
    report_backup(common, output, *report);
    return Ok{};
}

Status run_restore(const Values& values) {
    const CommonOptions common(values);
    const std::string output = values.text("output");
    const auto report = server::restore(values.text("archive"), output);
    if (!report) return report.error();
    report_backup(common, output, *report);
    return Ok{};
}

}  // namespace tetralight::cli
