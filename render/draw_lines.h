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

/// How far the surfaces of a picture are, in depth along the view, at the middles of the four
/// quarters of each pixel.
struct DepthImage {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<std::array<float, 4>> depths;
};

/// Distance to the first surface from a world position in a unit direction; infinite when there is
/// none. Called from many threads.
using TraceDistance = std::function<float(const glm::dvec3& origin, glm::vec3 direction)>;

[[nodiscard]] DepthImage render_depth(const Camera& camera, const RenderSettings& settings,
                                      const TraceDistance& trace);

/// Two ends, world space.
using LineSegment = std::array<glm::dvec3, 2>;

struct LineStyle {
    /// sRGB-encoded, 0 to 1.
    glm::vec3 color{1.0f};
    /// Of lines in front of all surfaces, and of those behind one; 1 = opaque.
    float opacity = 0.6f;
    float hidden_opacity = 0.05f;
    /// Pixels.
    float width = 1.0f;
};

/// Draws antialiased lines over a picture of the depth image's size that the camera took.
void draw_lines(Image8& image, const DepthImage& depth, const Camera& camera,
                std::span<const LineSegment> lines, const LineStyle& style);

}  // namespace tetralight
