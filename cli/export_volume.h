// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/base/result.h>
#include <tetralight/cli/values.h>
#include <tetralight/engines/export_target.h>

namespace tetralight::cli {

/// The target that `tetralight export` was asked for, by `--as` or by the extension of the output;
/// null if it writes images or a scene.
[[nodiscard]] const ExportTarget* chosen_export_target(const Values& values);

/// Writes a probe volume for an engine or a tool, and reports what is lost.
[[nodiscard]] Status export_volume(const Values& values, const ExportTarget& target);

}  // namespace tetralight::cli
