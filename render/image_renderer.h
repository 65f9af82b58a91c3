// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>

#include <tetralight/bake/image/image.h>
#include <tetralight/bake/scene/scene.h>

namespace tetralight {

/// A camera at `eye` that looks at `target`, with world Y up. If both are the same point it looks
/// along -Z.
[[nodiscard]] Camera look_at(const glm::dvec3& eye, const glm::dvec3& target, double fov_y_radians);

/// What a picture shows from its lower to its upper edge, metres: a linear function of depth.
struct PictureHeight {
    double at_eye = 0.0;     ///< 0 for perspective cameras
    double per_metre = 0.0;  ///< 0 for orthographic cameras

    [[nodiscard]] double at(double depth) const { return at_eye + per_metre * depth; }
};

[[nodiscard]] PictureHeight picture_height(const Camera& camera);

/// Distance of a position from the start of the ray that sees it: from the eye, or from the plane
/// through an orthographic camera.
[[nodiscard]] double view_distance(const Camera& camera, const glm::dvec3& position);

/// A ray of a picture, world space.
struct ViewRay {
    glm::dvec3 origin{0.0};
    glm::vec3 direction{0.0f};  ///< unit
};

/// Projection of a perspective or orthographic camera with square pixels. Picture coordinates are
/// pixels right and down from the upper left corner; the center of the first pixel is (0.5, 0.5).
class Projection {
  public:
    Projection(const Camera& camera, uint32_t width, uint32_t height);

    /// The ray through a point of the picture. It starts at the eye, or in the plane through an
    /// orthographic camera.
    [[nodiscard]] ViewRay ray(double x, double y) const;

    /// Width and height of a pixel at a depth, metres.
    [[nodiscard]] double pixel_size(double depth) const { return pixel_.at(depth); }

    /// View space: right, up and back from the eye.
    [[nodiscard]] glm::dvec3 view_from_world(const glm::dvec3& position) const;

    /// Picture coordinates and depth (-z) of a position in view space. Precondition: z < 0.
    [[nodiscard]] glm::dvec3 picture_from_view(const glm::dvec3& position) const;

    /// Depth of a point at a distance along a ray of the picture with this direction.
    [[nodiscard]] double depth(glm::vec3 direction, double distance) const;

  private:
    Camera camera_;
    double width_;
    double height_;
    PictureHeight pixel_;  // of one row
};

struct RenderSettings {
    uint32_t width = 960;
    uint32_t height = 540;
    /// Camera rays a pixel along each axis: the square of it in all.
    uint32_t samples_per_axis = 4;
    /// Factor before tone mapping; 0 = automatic (`automatic_exposure`).
    float exposure = 0.0f;
    /// Number of threads; 0 = one a core.
    uint32_t thread_count = 0;
};

/// Radiance seen from a world position in a unit direction. Called from many threads.
using TraceView = std::function<glm::vec3(const glm::dvec3& origin, glm::vec3 direction)>;

/// Averages radiance over each pixel, by rays on a regular grid in the pixel.
[[nodiscard]] ImageF render_view(const Camera& camera, const RenderSettings& settings,
                                 const TraceView& trace);

/// The exposure that brings the log-average luminance to middle grey, 0.18 (Reinhard et al. 2002,
/// equation 1); 1 for a black picture.
[[nodiscard]] float automatic_exposure(const ImageF& radiance);

/// Rounds sRGB-encoded colours, 0 to 1, to 8 bits.
[[nodiscard]] Image8 quantized(const ImageF& colors);

/// Exposes, tone-maps (Khronos PBR Neutral) and encodes as sRGB. An exposure of 0 is automatic.
[[nodiscard]] Image8 develop(const ImageF& radiance, float exposure);

}  // namespace tetralight
