// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/render/gizmos.h>

namespace tetralight {

/// The openings that a bake of a scene samples (`openings_of`): their rectangles, and nets over the
/// spots that directional lights throw through them. Returns the errors of
/// `TraceScene::make_static`.
[[nodiscard]] Result<std::vector<GizmoLines>> make_opening_lines(const Scene& scene);

}  // namespace tetralight
