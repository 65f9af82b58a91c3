// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/failure.h>
#include <tetralight/server/fsck.h>

namespace tetralight::cli {
namespace {

std::string words_of(const server::FolderCheck::Finding& finding) {
    const std::string_view kind = finding.kind;
    const char* words = kind == "missing"      ? "is missing"
                        : kind == "unreadable" ? "cannot be read"
                        : kind == "unknown"    ? "is unknown"
                                               : "is damaged";
    return str_cat(finding.path, " ", words, " (", finding.detail, ")");
}

}  // namespace

Status run_fsck(const Values& values) {
    const std::string data = values.text("data");
    const CommonOptions common(values);
    const auto check = server::check_folder(data);
    if (!check) return check.error();
    Json json{{"data", data},
              {"files", check->files},
              {"bytes", check->bytes},
              {"quarantined", check->quarantined},
              {"findings", Json::array()}};
    std::string message = data + ": ";
    for (const auto& finding : check->findings) {
        message += (json["findings"].empty() ? "" : "; ") + words_of(finding);
        json["findings"].push_back(
            {{"kind", finding.kind}, {"path", finding.path}, {"detail", finding.detail}});
    }
    if (!check->findings.empty()) return with_report({ErrorCode::Corrupt, message}, json);
    common.print(json, str_cat(printable(data), ": ", counted(check->files, "file"), ", ",
                               magnitude(static_cast<double>(check->bytes)), "B, all whole; ",
                               check->quarantined, " in quarantine\n"));
    return Ok{};
}

}  // namespace tetralight::cli
