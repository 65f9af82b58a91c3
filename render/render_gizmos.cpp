// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/render_gizmos.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include <tetralight/bake/image/draw_text.h>

namespace tetralight {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();

/// Distance along a ray from the camera of a depth image, looked up in that image.
class DepthImageDistance {
  public:
    DepthImageDistance(const DepthImage& depth, const Camera& camera)
        : depth_(depth), projection_(camera, depth.width, depth.height) {}

    float operator()(const glm::dvec3& origin, glm::vec3 direction) const {
        const glm::dvec3 view = projection_.view_from_world(origin + glm::dvec3(direction));
        const glm::dvec3 pixel = projection_.picture_from_view(view);
        const auto x =
            static_cast<uint32_t>(std::clamp(2.0 * pixel.x, 0.0, 2.0 * depth_.width - 1));
        const auto y =
            static_cast<uint32_t>(std::clamp(2.0 * pixel.y, 0.0, 2.0 * depth_.height - 1));
        const auto& quarters = depth_.depths[size_t{y / 2} * depth_.width + x / 2];
        const float depth = quarters[y % 2 * 2 + x % 2];
        return depth / static_cast<float>(projection_.depth(direction, 1.0));
    }

  private:
    const DepthImage& depth_;
    Projection projection_;
};

void draw_labels(Image8& image, const Camera& camera, std::span<const GizmoLabel> labels) {
    const Projection projection(camera, image.width, image.height);
    for (const GizmoLabel& label : labels) {
        const glm::dvec3 view = projection.view_from_world(label.position);
        if (!(view.z < 0.0)) continue;
        const glm::dvec3 pixel = projection.picture_from_view(view);
        draw_text(image, static_cast<float>(pixel.x) + 10.0f, static_cast<float>(pixel.y) - 8.0f,
                  label.text);
    }
}

}  // namespace

PictureSource ray_traced_pictures(const SceneShader& shader, const ProbeVolumeView& volume,
                                  SurfaceView view) {
    PictureSource source;
    source.is_light = is_light(view);
    source.radiance = [&shader, volume, view](const Camera& camera, const RenderSettings& settings,
                                              std::span<const LightBall> lit) -> Result<ImageF> {
        const auto balls = LightBalls::make(lit);
        if (!balls) return balls.error();
        return render_view(camera, settings, [&](const glm::dvec3& origin, glm::vec3 direction) {
            auto nearest = shader.shade(origin, direction, view);
            const auto ball = balls->shade(origin, direction);
            if (ball && (!nearest || ball->distance < nearest->distance)) nearest = ball;
            if (nearest) return nearest->radiance;
            return view == SurfaceView::Shaded ? sky_radiance(volume, direction) : glm::vec3(0.0f);
        });
    };
    source.depth = [&shader](const Camera& camera, const RenderSettings& settings,
                             std::span<const LightBall> lit) -> Result<DepthImage> {
        const auto balls = LightBalls::make(lit);
        if (!balls) return balls.error();
        return render_depth(camera, settings, [&](const glm::dvec3& origin, glm::vec3 direction) {
            const auto ball = balls->find(origin, direction);
            return std::min(shader.distance(origin, direction).value_or(kNone),
                            ball ? ball->distance : kNone);
        });
    };
    return source;
}

Result<Image8> render_gizmos(const PictureSource& source, const ProbeVolumeView& volume,
                             const Camera& camera, const RenderSettings& settings,
                             const Gizmos& gizmos, ProbeColor probe_color) {
    const auto radiance = source.radiance(camera, settings, gizmos.balls);
    if (!radiance) return radiance.error();
    Image8 image = source.is_light ? develop(*radiance, settings.exposure) : quantized(*radiance);
    if (gizmos.lines.empty() && gizmos.health_balls.empty()) return image;

    const auto depth = source.depth(camera, settings, gizmos.balls);
    if (!depth) return depth.error();
    if (!gizmos.health_balls.empty()) {
        const auto balls = LightBalls::make(gizmos.health_balls);
        if (!balls) return balls.error();
        draw_health_balls(image, camera, settings, DepthImageDistance(*depth, camera), *balls,
                          volume, probe_color);
    }
    for (const GizmoLines& group : gizmos.lines) {
        draw_lines(image, *depth, camera, group.lines, group.style);
    }
    draw_labels(image, camera, gizmos.labels);
    return image;
}

}  // namespace tetralight
