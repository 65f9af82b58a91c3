// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/cli/values.h>
#include <tetralight/render/gizmos.h>
#include <tetralight/render/surface_view.h>

namespace tetralight::cli {

/// What a picture shows: `show`, `ball_radius`, `probe_color`.
struct ShowSettings {
    GizmoSettings gizmos;
    SurfaceView view = SurfaceView::Shaded;
};

/// Throws a `UsageError` if `show` has an unknown word, two views of surfaces, or needs lightmaps
/// that are not given.
[[nodiscard]] ShowSettings show_settings(const Values& values);

}  // namespace tetralight::cli
