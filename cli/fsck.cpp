// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/failure.h>
#include <tetralight/server/fsck.h>

namespace tetralight::cli {

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
        message += str_cat(json["findings"].empty() ? "" : "; ", finding.path, " is ", finding.kind,
                           " (", finding.detail, ")");
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
