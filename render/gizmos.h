// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tetralight/lppv/lppv.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/render/draw_lines.h>
#include <tetralight/render/health_balls.h>
#include <tetralight/render/light_balls.h>

namespace tetralight {

/// What a picture shows of a volume in addition to its light.
struct GizmoSettings {
    /// The edges of tetrahedra, and the edges of the hull in another colour.
    bool has_cells = false;
    /// Probes as balls.
    bool has_probes = false;
    /// The grid points of proxy volumes as balls.
    bool has_proxies = false;
    /// The openings that a bake samples (`make_opening_lines`).
    bool has_openings = false;
    /// The seams of lightmaps (`make_seam_lines`).
    bool has_seams = false;
    /// A position: shows its cell, the cell's probes with their weights, and the interpolated
    /// light.
    std::optional<glm::dvec3> selection = std::nullopt;
    /// What the balls of probes show.
    ProbeColor probe_color = ProbeColor::Light;
    /// Radius of balls, metres; 0 = from the spacing of probes or grid points.
    float ball_radius = 0.0f;
};

/// Lines of one style, drawn over a picture.
struct GizmoLines {
    std::vector<LineSegment> lines;
    LineStyle style;
};

/// Text beside a position, drawn over a picture.
struct GizmoLabel {
    glm::dvec3 position{0.0};
    std::string text;
};

struct Gizmos {
    /// Balls that are part of the scene: surfaces hide them.
    std::vector<LightBall> balls;
    /// Balls that show the health of probes, one a probe, drawn over the picture.
    std::vector<LightBall> health_balls;
    std::vector<GizmoLines> lines;
    std::vector<GizmoLabel> labels;
};

/// All but openings and seams, which belong to the scene and not to the volume.
[[nodiscard]] Gizmos make_gizmos(const ProbeVolumeView& volume, std::span<const Lppv> proxies,
                                 const GizmoSettings& settings);

}  // namespace tetralight
