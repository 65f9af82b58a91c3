// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/base/result.h>
#include <tetralight/cli/values.h>
#include <tetralight/engines/export_target.h>

namespace tetralight::cli {

/// The target that `--as` names, or the only one with the extension of the output; null if there is
/// none.
[[nodiscard]] const ExportTarget* chosen_export_target(const Values& values);

/// Writes a probe volume for an engine or a tool, and reports what is lost.
[[nodiscard]] Status export_volume(const Values& values, const ExportTarget& target);

}  // namespace tetralight::cli
