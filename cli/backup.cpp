// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/common.h>
#include <tetralight/server/backup.h>

namespace tetralight::cli {
namespace {

using Copy = Result<server::BackupReport>(const std::string& from, const std::string& to);

Status run(const Values& values, std::string_view from, Copy copy) {
    const CommonOptions common(values);
    const std::string output = values.text("output");
    const auto report = copy(values.text(from), output);
    if (!report) return report.error();
    const Json json{{"output", output},
                    {"files", report->files},
                    {"bytes", report->bytes},
                    {"missing", report->missing}};
    common.warn(report->missing);
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
