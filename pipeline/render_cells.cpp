// SPDX-License-Identifier: Apache-2.0
#include "pipeline/render_cells.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "pipeline/draw_lines.h"
#include "pipeline/probe_balls.h"
#include "probes/build/wireframe.h"

namespace tetralight {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();

const LineStyle kInnerStyle{{0.85f, 0.96f, 1.00f}, 0.34f, 0.03f, 1.0f};
const LineStyle kHullStyle{{1.00f, 0.74f, 0.32f}, 0.70f, 0.06f, 1.1f};

/// The scene and, where the user wants them, its probes.
class Shader {
  public:
    [[nodiscard]] static Result<Shader> make(const Scene& scene, const ProbeVolumeView& volume,
                                             const CellOverlay& overlay) {
        auto surfaces = SceneShader::make(scene, volume, overlay.movers);
        if (!surfaces) return surfaces.error();
        Shader shader(std::move(*surfaces));
        if (overlay.probe_radius > 0.0f) {
            auto made = ProbeBalls::make(volume, overlay.probe_radius);
            if (!made) return made.error();
            shader.balls_ = std::move(*made);
        }
        if (overlay.proxy_radius > 0.0f) {
            auto made = ProbeBalls::make(shader.surfaces_.proxy_volumes(), overlay.proxy_radius);
            if (!made) return made.error();
            shader.proxy_balls_ = std::move(*made);
        }
        return shader;
    }

    [[nodiscard]] std::optional<SceneShader::Shaded> shade(const glm::dvec3& origin,
                                                           glm::vec3 direction) const {
        auto nearest = surfaces_.shade(origin, direction);
        for (const auto* balls : {&balls_, &proxy_balls_}) {
            const auto ball = *balls ? (*balls)->shade(origin, direction) : std::nullopt;
            if (ball && (!nearest || ball->distance < nearest->distance)) nearest = ball;
        }
        return nearest;
    }

    /// Only the scene.
    [[nodiscard]] const SceneShader& surfaces() const { return surfaces_; }

    [[nodiscard]] const std::optional<ProbeBalls>& balls() const { return balls_; }

    /// To the first surface or ball; infinite where there is none.
    [[nodiscard]] float distance(const glm::dvec3& origin, glm::vec3 direction) const {
        const auto ball = balls_ ? balls_->shade(origin, direction) : std::nullopt;
        return std::min(surfaces_.distance(origin, direction).value_or(kNone),
                        ball ? ball->distance : kNone);
    }

  private:
    explicit Shader(SceneShader surfaces) : surfaces_(std::move(surfaces)) {}

    SceneShader surfaces_;
    std::optional<ProbeBalls> balls_;
    std::optional<ProbeBalls> proxy_balls_;
};

std::vector<Line> lines(const Wireframe& wireframe, std::span<const ProbeEdge> edges) {
    std::vector<Line> result;
    for (const auto [a, b] : edges) {
        result.push_back({wireframe.positions[a], wireframe.positions[b]});
    }
    return result;
}

}  // namespace

Result<Image8> render_cells(const Scene& scene, const ProbeVolumeView& volume, const Camera& camera,
                            const RenderSettings& settings, const CellOverlay& overlay) {
    const auto shader = Shader::make(scene, volume, overlay);
    if (!shader) return shader.error();
    const bool shows_light = overlay.probe_color == ProbeColor::Light;
    const ImageF radiance =
        render_view(camera, settings, [&](const glm::dvec3& origin, glm::vec3 direction) {
            const auto shaded = shows_light ? shader->shade(origin, direction)
                                            : shader->surfaces().shade(origin, direction);
            return shaded ? shaded->radiance : sky_radiance(volume, direction);
        });
    Image8 image = develop(radiance, settings.exposure);
    if (shader->balls() && !shows_light) {
        const auto surfaces = [&](const glm::dvec3& origin, glm::vec3 direction) {
            return shader->surfaces().distance(origin, direction).value_or(kNone);
        };
        draw_health_balls(image, camera, settings, surfaces, *shader->balls(), overlay.probe_color);
    }
    if (!overlay.has_edges) return image;

    const DepthImage depth =
        render_depth(camera, settings, [&](const glm::dvec3& origin, glm::vec3 direction) {
            return shader->distance(origin, direction);
        });
    const Wireframe wireframe = make_wireframe(volume);
    draw_lines(image, depth, camera, lines(wireframe, wireframe.inner_edges), kInnerStyle);
    draw_lines(image, depth, camera, lines(wireframe, wireframe.hull_edges), kHullStyle);
    return image;
}

}  // namespace tetralight
