// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/shared_settings.h>

namespace tetralight::settings {
namespace {

constexpr Setting kData = input_file("data", "Data folder of a server (serve --data)");

constexpr Setting kChecked[] = {kData};
constexpr Setting kStored[] = {kData, output_file(".tar", "Archive to write, .tar (- = stdout)")};
constexpr Setting kRestored[] = {
    input_file("archive", "Archive of a data folder (tetralight backup; - = stdin)"),
    output_file("", "Data folder to create; it must not exist, or be empty")};

constexpr Group kFsckGroups[] = {{"Files", kChecked}, {"Common options", kCommonSettings}};
constexpr Group kBackupGroups[] = {{"Files", kStored}, {"Common options", kCommonSettings}};
constexpr Group kRestoreGroups[] = {{"Files", kRestored}, {"Common options", kCommonSettings}};

}  // namespace

const Table kFsck{.command = "fsck",
                  .summary = "Check the data folder of a server: its database and every file",
                  .examples = "tetralight fsck /var/lib/tetralight",
                  .groups = kFsckGroups};

const Table kBackup{.command = "backup",
                    .summary = "Store the data folder of a server, which may run, in an archive",
                    .examples = "tetralight backup /var/lib/tetralight -o tetralight.tar",
                    .groups = kBackupGroups};

const Table kRestore{.command = "restore",
                     .summary = "Create the data folder of a server from an archive",
                     .examples = "tetralight restore tetralight.tar -o /var/lib/tetralight",
                     .groups = kRestoreGroups};

}  // namespace tetralight::settings
