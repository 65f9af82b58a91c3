// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/grid_preview.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include <tetralight/bake/image/write_image.h>
#include <tetralight/bake/placement/light_difference.h>
#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/render/light_balls.h>
#include <tetralight/render/render_scene.h>

namespace tetralight::cli {
namespace {

/// Enough for a picture.
constexpr uint32_t kSampleCount = 128;

/// Metres from each probe to the nearest other one: both belong to one cell.
std::vector<float> nearest_distances(const ProbeVolumeView& volume) {
    std::vector<float> nearest(volume.probe_count(), std::numeric_limits<float>::infinity());
    for (const Cell& cell : volume.cells) {
        for (const uint32_t a : cell.vertices) {
            for (const uint32_t b : cell.vertices) {
                if (a == b || a == kNoIndex || b == kNoIndex) continue;
                const float distance = glm::distance(volume.positions[a], volume.positions[b]);
                nearest[a] = std::min(nearest[a], distance);
            }
        }
    }
    return nearest;
}

/// What the picture shows from its lower to its upper edge at a position, metres.
double height_at(const Camera& camera, const glm::dvec3& position) {
    return picture_height(camera).at(view_distance(camera, position));
}

/// Balls that do not touch, except those that would be too small to be visible.
std::vector<LightBall> probe_balls(const ProbeVolumeView& volume, const Camera& camera) {
    constexpr float kOfSpacing = 0.35f;
    // Radii, as fractions of the picture's height.
    constexpr double kLargest = 0.008, kSmallest = 0.0015;
    const std::vector<float> nearest = nearest_distances(volume);
    std::vector<LightBall> balls;
    for (uint32_t i = 0; i < volume.probe_count(); ++i) {
        const glm::dvec3 center = volume.info.world_origin + glm::dvec3(volume.positions[i]);
        const double height = height_at(camera, center);
        const float radius =
            std::clamp(kOfSpacing * nearest[i], static_cast<float>(kSmallest * height),
                       static_cast<float>(kLargest * height));
        balls.push_back({center, radius, volume.irradiance[i]});
    }
    return balls;
}

/// Small balls at places that no probe covers: red ones outside of the tetrahedra, violet ones out
/// of sight. As bright as the brightest probes, so that they show at any exposure.
std::vector<LightBall> uncovered_balls(const ProbeGrid& grid, const ProbeVolumeView& volume,
                                       const Camera& camera) {
    constexpr glm::vec3 kOutside(1.0f, 0.0f, 0.0f), kUnseen(0.7f, 0.0f, 1.0f);
    constexpr double kRadius = 0.003;  // of the picture's height
    double brightest = 0.0;
    for (const IrradianceSh& light : volume.irradiance) {
        brightest = std::max(brightest, mean_irradiance(light));
    }
    const auto scale = static_cast<float>(brightest > 0.0 ? brightest / std::numbers::pi : 1.0);
    std::vector<LightBall> balls;
    for (const UncoveredPlace& place : grid.uncovered) {
        const glm::vec3 color = place.cover == Cover::HullCell ? kOutside : kUnseen;
        balls.push_back({place.position,
                         static_cast<float>(kRadius * height_at(camera, place.position)),
                         irradiance_from_radiance(constant_radiance(scale * color))});
    }
    return balls;
}

/// Radiance along a ray: of the scene and the first ball, which is dimmed if it is hidden.
glm::vec3 radiance_along(const SceneShader& shader, const LightBalls& balls,
                         const ProbeVolumeView& volume, const glm::dvec3& origin,
                         glm::vec3 direction) {
    constexpr float kHidden = 0.5f;
    const auto surface = shader.shade(origin, direction);
    const glm::vec3 behind = surface ? surface->radiance : sky_radiance(volume, direction);
    const auto ball = balls.shade(origin, direction);
    if (!ball) return behind;
    const bool is_hidden = surface && surface->distance < ball->distance;
    return is_hidden ? glm::mix(behind, ball->radiance, kHidden) : ball->radiance;
}

}  // namespace

Status GridPreview::choose_camera(const Scene& scene, const std::string& scene_path) {
    if (path.empty()) return Ok{};
    const auto camera = view.camera_in(scene, scene_path);
    if (!camera) return camera.error();
    camera_ = *camera;
    return Ok{};
}

Status GridPreview::write(const Scene& scene, const ProbeGrid& grid, uint32_t thread_count) {
    BakeVolumeSettings settings;
    settings.bake.sample_count = kSampleCount;
    settings.bake.thread_count = thread_count;
    const auto baked = bake_volume(scene, grid.groups, settings);
    if (!baked) return baked.error();
    const ProbeVolumeView volume = baked->volume.view();
    const auto shader = SceneShader::make(scene, volume);
    if (!shader) return shader.error();
    std::vector<LightBall> all = probe_balls(volume, camera_);
    const std::vector<LightBall> marks = uncovered_balls(grid, volume, camera_);
    all.insert(all.end(), marks.begin(), marks.end());
    const auto balls = LightBalls::make(all);
    if (!balls) return balls.error();
    view.settings.thread_count = thread_count;
    const ImageF image =
        render_view(camera_, view.settings, [&](const glm::dvec3& origin, glm::vec3 direction) {
            return radiance_along(*shader, *balls, volume, origin, direction);
        });
    return write_png(path, develop(image, view.settings.exposure));
}

}  // namespace tetralight::cli
