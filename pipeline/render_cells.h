// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bake/image/image.h"
#include "pipeline/health_balls.h"
#include "pipeline/render_scene.h"

namespace tetralight {

/// What a picture shows of a volume's cells beside their light.
struct CellOverlay {
    /// The edges of tetrahedra, and in another colour those of the hull.
    bool has_edges = false;
    /// Probes as balls of this radius; 0 = none.
    float probe_radius = 0.0f;
    /// What they show.
    ProbeColor probe_color = ProbeColor::Light;
    /// Points of the proxy volumes of the scene's objects as balls of this radius; 0 = none.
    float proxy_radius = 0.0f;
    MoverLight movers = MoverLight::AsTheScene;
};

/// Renders and develops the scene as `render_scene` does, with probes among its surfaces and cell
/// edges over them; edges behind a surface are faint.
[[nodiscard]] Result<Image8> render_cells(const Scene& scene, const ProbeVolumeView& volume,
                                          const Camera& camera, const RenderSettings& settings,
                                          const CellOverlay& overlay);

}  // namespace tetralight
