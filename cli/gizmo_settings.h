// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/cli/values.h>
#include <tetralight/render/gizmos.h>

namespace tetralight::cli {

/// What a picture shows of a volume: `show`, `ball_radius`, `probe_color`. Throws a `UsageError` if
/// `show` has an unknown word.
[[nodiscard]] GizmoSettings gizmo_settings(const Values& values);

}  // namespace tetralight::cli
