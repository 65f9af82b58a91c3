// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/draw_lines.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <utility>

#include <tetralight/bake/parallel.h>
#include <tetralight/base/contract.h>

namespace tetralight {
namespace {

/// Distance of the near plane.
constexpr double kNearest = 1e-4;

/// A line is hidden if its depth exceeds that of a surface by this fraction of what the picture
/// shows there from its lower to its upper edge. Probes may lie in a surface.
constexpr double kDepthTolerance = 2e-3;

/// A line in the picture: x and y in pixels, z = depth.
struct PictureLine {
    glm::dvec3 a{0.0};
    glm::dvec3 b{0.0};
};

/// Depth of a point of a line; `t`: its place in the picture, from 0 at `a` to 1 at `b`. Depth and
/// 1, both divided by the size of a pixel, are linear in the picture.
double depth_at(const Projection& projection, const PictureLine& line, double t) {
    const double toward_a = (1.0 - t) * projection.pixel_size(line.b.z);
    const double toward_b = t * projection.pixel_size(line.a.z);
    return glm::mix(line.a.z, line.b.z, toward_b / (toward_a + toward_b));
}

/// Clips at the near plane. Empty if the whole line is behind it.
std::optional<PictureLine> project(const Projection& projection, const LineSegment& line) {
    glm::dvec3 a = projection.view_from_world(line[0]);
    glm::dvec3 b = projection.view_from_world(line[1]);
    if (a.z > b.z) std::swap(a, b);  // a is the farther one
    if (!(a.z < -kNearest)) return std::nullopt;
    if (b.z > -kNearest) b = glm::mix(a, b, (-kNearest - a.z) / (b.z - a.z));
    return PictureLine{projection.picture_from_view(a), projection.picture_from_view(b)};
}

/// Draws lines pixel by pixel along their major axis.
class Pen {
  public:
    Pen(Image8& image, const DepthImage& depth, const Projection& projection,
        const LineStyle& style)
        : image_(image), depth_(depth), projection_(projection), style_(style) {}

    void draw(const PictureLine& line) {
        const glm::dvec2 a(line.a), offset = glm::dvec2(line.b) - a;
        const int major = std::abs(offset.x) >= std::abs(offset.y) ? 0 : 1;
        const int minor = 1 - major;
        const double length = glm::length(offset);
        if (length == 0.0) return;
        const double reach = 0.5 * (1.0 + style_.width);
        const double half_width = reach * length / std::abs(offset[major]);
        const auto [first, last] = pixels(std::min(a[major], line.b[major]) - reach,
                                          std::max(a[major], line.b[major]) + reach, size(major));
        for (int i = first; i <= last; ++i) {
            const double center = a[minor] + (i + 0.5 - a[major]) * offset[minor] / offset[major];
            const auto [min, max] = pixels(center - half_width, center + half_width, size(minor));
            for (int j = min; j <= max; ++j) {
                major == 0 ? draw_pixel(line, i, j) : draw_pixel(line, j, i);
            }
        }
    }

  private:
    struct Range {
        int first = 0;
        int last = -1;
    };

    /// The pixels of one axis that an interval touches.
    static Range pixels(double min, double max, uint32_t count) {
        const double last = static_cast<double>(count) - 1.0;
        return {static_cast<int>(std::clamp(std::floor(min), 0.0, last + 1.0)),
                static_cast<int>(std::clamp(std::floor(max), -1.0, last))};
    }

    [[nodiscard]] uint32_t size(int axis) const { return axis == 0 ? image_.width : image_.height; }

    void draw_pixel(const PictureLine& line, int x, int y) {
        const glm::dvec2 a(line.a), offset = glm::dvec2(line.b) - a;
        const glm::dvec2 pixel(x + 0.5, y + 0.5);
        const double t =
            std::clamp(glm::dot(pixel - a, offset) / glm::dot(offset, offset), 0.0, 1.0);
        const double distance = glm::distance(pixel, a + t * offset);
        const double coverage = std::clamp(0.5 * (1.0 + style_.width) - distance, 0.0, 1.0);
        if (coverage == 0.0) return;
        const size_t index = static_cast<size_t>(y) * image_.width + static_cast<size_t>(x);
        const double depth = depth_at(projection_, line, t);
        blend(image_.pixels[index], static_cast<float>(coverage) * opacity(index, depth));
    }

    [[nodiscard]] float opacity(size_t pixel, double depth) const {
        const double tolerance = kDepthTolerance * image_.height * projection_.pixel_size(depth);
        int visible_count = 0;
        for (const float surface : depth_.depths[pixel]) {
            visible_count += depth <= static_cast<double>(surface) + tolerance;
        }
        return glm::mix(style_.hidden_opacity, style_.opacity,
                        static_cast<float>(visible_count) / 4.0f);
    }

    void blend(std::array<uint8_t, 4>& pixel, float alpha) const {
        for (int i = 0; i < 3; ++i) {
            const float old = static_cast<float>(pixel[i]);
            pixel[i] =
                static_cast<uint8_t>(std::lround(glm::mix(old, 255.0f * style_.color[i], alpha)));
        }
    }

    Image8& image_;
    const DepthImage& depth_;
    const Projection& projection_;
    const LineStyle& style_;
};

}  // namespace

DepthImage render_depth(const Camera& camera, const RenderSettings& settings,
                        const TraceDistance& trace) {
    DepthImage image{settings.width, settings.height, {}};
    image.depths.resize(size_t{settings.width} * settings.height);
    const Projection projection(camera, settings.width, settings.height);
    parallel_for(settings.height, settings.thread_count, [&](size_t row) {
        for (uint32_t column = 0; column < settings.width; ++column) {
            for (int i = 0; i < 4; ++i) {
                const double y = static_cast<double>(row) + (i / 2 == 0 ? 0.25 : 0.75);
                const ViewRay ray = projection.ray(column + (i % 2 == 0 ? 0.25 : 0.75), y);
                const auto distance = static_cast<double>(trace(ray.origin, ray.direction));
                image.depths[row * settings.width + column][i] =
                    static_cast<float>(projection.depth(ray.direction, distance));
            }
        }
    });
    return image;
}

void draw_lines(Image8& image, const DepthImage& depth, const Camera& camera,
                std::span<const LineSegment> lines, const LineStyle& style) {
    TETRALIGHT_ASSERT(image.width == depth.width && image.height == depth.height,
                      "picture and depth image must have the same size");
    const Projection projection(camera, image.width, image.height);
    Pen pen(image, depth, projection, style);
    for (const LineSegment& line : lines) {
        const auto projected = project(projection, line);
        if (projected) pen.draw(*projected);
    }
}

}  // namespace tetralight
