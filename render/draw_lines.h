// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/image/image.h>
#include <tetralight/render/image_renderer.h>

namespace tetralight {

/// Depth along the view of the surfaces in a picture: four samples a pixel, at the centers of its
/// quarters (upper left, upper right, lower left, lower right). Infinite without a surface.
struct DepthImage {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<std::array<float, 4>> depths;
};

/// Distance to the first surface from a world position in a unit direction; infinite if there is
/// none. Called from many threads.
using TraceDistance = std::function<float(const glm::dvec3& origin, glm::vec3 direction)>;

/// Traces four rays a pixel.
[[nodiscard]] DepthImage render_depth(const Camera& camera, const RenderSettings& settings,
                                      const TraceDistance& trace);

/// Two end points, world space.
using LineSegment = std::array<glm::dvec3, 2>;

struct LineStyle {
    /// sRGB-encoded, 0 to 1.
    glm::vec3 color{1.0f};
    /// Opacity in front of all surfaces, 0 to 1.
    float opacity = 0.6f;
    /// Opacity behind a surface, 0 to 1.
    float hidden_opacity = 0.05f;
    float width = 1.0f;  ///< pixels
};

/// Draws antialiased lines over a picture from the same camera.
/// Precondition: picture and depth image have the same size.
void draw_lines(Image8& image, const DepthImage& depth, const Camera& camera,
                std::span<const LineSegment> lines, const LineStyle& style);

}  // namespace tetralight
