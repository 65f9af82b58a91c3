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

/// What a picture shows of a volume beside its light.
struct GizmoSettings {
    /// The edges of tetrahedra, and in another colour those of the hull.
    bool has_cells = false;
    /// Probes as balls.
    bool has_probes = false;
    /// The points of proxy volumes as balls.
    bool has_proxies = false;
    /// A place: its cell, the cell's probes with their weights, and the light that they give.
    std::optional<glm::dvec3> selection = std::nullopt;
    /// What the balls of probes show.
    ProbeColor probe_color = ProbeColor::Light;
    /// Of balls, metres; 0 = from the spacing of the probes or points.
    float ball_radius = 0.0f;
};

/// Lines of one style, and text, to be drawn over a picture.
struct GizmoLines {
    std::vector<LineSegment> lines;
    LineStyle style;
};

struct GizmoLabel {
    glm::dvec3 position{0.0};
    std::string text;
};

struct Gizmos {
    /// Stand among the surfaces.
    std::vector<LightBall> balls;
    /// Those of probes that show health instead, one a probe: drawn over the picture.
    std::vector<LightBall> health_balls;
    std::vector<GizmoLines> lines;
    std::vector<GizmoLabel> labels;
};

[[nodiscard]] Gizmos make_gizmos(const ProbeVolumeView& volume, std::span<const Lppv> proxies,
                                 const GizmoSettings& settings);

}  // namespace tetralight
