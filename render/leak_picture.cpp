// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/leak_picture.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <string_view>
#include <vector>

#include <tetralight/bake/image/draw_text.h>
#include <tetralight/bake/image/srgb.h>
#include <tetralight/bake/parallel.h>
#include <tetralight/base/box.h>
#include <tetralight/render/image_renderer.h>
#include <tetralight/render/render_scene.h>

namespace tetralight {
namespace {

/// Sides of the views together, pixels.
constexpr double kWidth = 960.0, kHeight = 900.0;
/// Height of the line of text over each view, and of the legend below them.
constexpr uint32_t kTextHeight = 26;
constexpr uint32_t kLegendWidth = 700;
constexpr uint32_t kSamplesPerAxis = 2;
/// Marks rays that start in a wall or meet nothing.
constexpr float kCutWall = -1.0f, kNothing = -2.0f;

/// A view along an axis: pictures of positions, right and down, and the direction of sight.
struct Projection {
    int right = 0, down = 2, along = 1;
    /// 1 if the coordinate grows in that direction.
    double down_sign = 1.0;
    double cut = 0.0;
    const char* title = "";
};

/// One view of the scene at some place of the picture.
struct Panel {
    Projection view;
    Box<glm::dvec3> bounds;
    double pixels_per_metre = 1.0;
    uint32_t top = 0;

    [[nodiscard]] uint32_t extent(int axis) const {
        return std::max(1u,
                        static_cast<uint32_t>(std::lround(bounds.size()[axis] * pixels_per_metre)));
    }

    [[nodiscard]] uint32_t width() const { return extent(view.right); }

    [[nodiscard]] uint32_t height() const { return extent(view.down); }

    /// The position on the cut at a point of the panel.
    [[nodiscard]] glm::dvec3 position(double x, double y) const {
        glm::dvec3 position(0.0);
        position[view.right] = bounds.min[view.right] + x / pixels_per_metre;
        position[view.down] = view.down_sign > 0.0 ? bounds.min[view.down] + y / pixels_per_metre
                                                   : bounds.max[view.down] - y / pixels_per_metre;
        position[view.along] = view.cut;
        return position;
    }

    /// The point of the panel of a position.
    [[nodiscard]] glm::dvec2 point(const glm::dvec3& position) const {
        const double down = view.down_sign > 0.0 ? position[view.down] - bounds.min[view.down]
                                                 : bounds.max[view.down] - position[view.down];
        return pixels_per_metre * glm::dvec2(position[view.right] - bounds.min[view.right], down);
    }

    [[nodiscard]] glm::vec3 sight() const {
        glm::vec3 direction(0.0f);
        direction[view.along] = -1.0f;
        return direction;
    }
};

/// The coordinate with half of the light through walls on either side; without such light, with
/// half of the places.
double middle_of_leaks(const LeakReport& report, int axis) {
    std::vector<std::pair<double, double>> weighted;
    double sum = 0.0;
    const bool has_leaks = report.through_walls.mean > 0.0;
    for (const LeakPlace& place : report.places) {
        const double weight = has_leaks ? place.through_walls() : 1.0;
        weighted.emplace_back(place.position[axis], weight);
        sum += weight;
    }
    std::ranges::sort(weighted);
    double before = 0.0;
    for (const auto& [coordinate, weight] : weighted) {
        before += weight;
        if (before >= 0.5 * sum) return coordinate;
    }
    return weighted.back().first;
}

/// The box of the places and a twentieth more.
Box<glm::dvec3> bounds_of(const LeakReport& report) {
    auto box = Box<glm::dvec3>::empty();
    for (const LeakPlace& place : report.places) box = union_of(box, place.position);
    const glm::dvec3 margin = glm::max(0.05 * box.size(), glm::dvec3(0.3));
    return {box.min - margin, box.max + margin};
}

class LeakPicture {
  public:
    LeakPicture(const SceneShader& shader, const TraceScene& traced, const LeakReport& report)
        : shader_(shader), traced_(traced), report_(report) {
        const Box<glm::dvec3> bounds = bounds_of(report);
        const glm::dvec3 size = bounds.size();
        const double scale = std::min(kWidth / size.x, kHeight / (size.y + size.z));
        plan_ = {{0, 2, 1, 1.0, middle_of_leaks(report, 1), "from above, cut at y = %.2f m"},
                 bounds,
                 scale,
                 kTextHeight};
        section_ = {
            {0, 1, 2, -1.0, middle_of_leaks(report, 2), "from the front, cut at z = %.2f m"},
            bounds,
            scale,
            2 * kTextHeight + plan_.height()};
        image_.width = std::max(plan_.width(), kLegendWidth);
        image_.height = section_.top + section_.height() + kTextHeight;
        image_.pixels.assign(size_t{image_.width} * image_.height, {38, 40, 44, 255});
    }

    Image8 draw(uint32_t thread_count) {
        for (const Panel* panel : {&plan_, &section_}) {
            draw_scene(*panel, thread_count);
            draw_balls(*panel);
            draw_title(*panel);
        }
        draw_legend();
        return std::move(image_);
    }

  private:
    /// Radiance seen from the cut, or kCutWall or kNothing in all channels.
    [[nodiscard]] glm::vec3 look(const Panel& panel, double x, double y) const {
        const glm::dvec3 origin = panel.position(x, y);
        if (is_in_wall(traced_.render_from_world(origin))) return glm::vec3(kCutWall);
        const auto shaded = shader_.shade(origin, panel.sight());
        return shaded ? shaded->radiance : glm::vec3(kNothing);
    }

    /// True if along some axis surfaces on both sides show their backs. One side does not suffice:
    /// where walls stand on a floor, either may be hit.
    [[nodiscard]] bool is_in_wall(glm::vec3 position) const {
        for (int axis = 0; axis < 3; ++axis) {
            glm::vec3 direction(0.0f);
            direction[axis] = 1.0f;
            const auto side = traced_.intersect_side({position, direction});
            if (!side || !side->is_from_behind) continue;
            const auto other = traced_.intersect_side({position, -direction});
            if (other && other->is_from_behind) return true;
        }
        return false;
    }

    void draw_scene(const Panel& panel, uint32_t thread_count) {
        const uint32_t n = kSamplesPerAxis, width = panel.width() * n, height = panel.height() * n;
        ImageF seen{width, height, std::vector<glm::vec3>(size_t{width} * height)};
        parallel_for(height, thread_count, [&](size_t row) {
            for (uint32_t column = 0; column < width; ++column) {
                seen.pixels[row * width + column] =
                    look(panel, (column + 0.5) / n, (static_cast<double>(row) + 0.5) / n);
            }
        });
        const Image8 developed = develop(lit_part(seen), 0.0f);
        for (uint32_t y = 0; y < panel.height(); ++y) {
            for (uint32_t x = 0; x < panel.width(); ++x) {
                glm::vec3 sum(0.0f);
                for (uint32_t i = 0; i < n * n; ++i) {
                    const size_t at = size_t{y * n + i / n} * width + x * n + i % n;
                    sum += shown(seen.pixels[at], developed.pixels[at]);
                }
                set(x, panel.top + y, sum / static_cast<float>(n * n));
            }
        }
    }

    /// Without marks, which are negative.
    static ImageF lit_part(ImageF image) {
        for (glm::vec3& pixel : image.pixels) pixel = glm::max(pixel, glm::vec3(0.0f));
        return image;
    }

    /// sRGB-encoded, 0 to 1. The scene is pale, so that balls stand out.
    static glm::vec3 shown(glm::vec3 radiance, const std::array<uint8_t, 4>& developed) {
        if (radiance.x == kCutWall) return glm::vec3(0.06f);
        if (radiance.x == kNothing) return glm::vec3(0.15f, 0.16f, 0.17f);
        const glm::vec3 color(developed[0], developed[1], developed[2]);
        return glm::mix(glm::vec3(0.5f), color / 255.0f, 0.6f);
    }

    void set(uint32_t x, uint32_t y, glm::vec3 color) {
        if (x >= image_.width || y >= image_.height) return;
        auto& pixel = image_.pixels[size_t{y} * image_.width + x];
        for (int c = 0; c < 3; ++c) {
            pixel[static_cast<size_t>(c)] =
                static_cast<uint8_t>(std::lround(255.0f * glm::clamp(color[c], 0.0f, 1.0f)));
        }
    }

    [[nodiscard]] glm::vec3 color_at(uint32_t x, uint32_t y) const {
        const auto& pixel = image_.pixels[size_t{y} * image_.width + x];
        return glm::vec3(pixel[0], pixel[1], pixel[2]) / 255.0f;
    }

    /// A disc with a dark rim.
    void draw_ball(const glm::dvec2& center, double radius, glm::vec3 color) {
        const auto first = [&](double x) {
            return static_cast<int64_t>(std::floor(x - radius - 1));
        };
        const int64_t size = static_cast<int64_t>(std::ceil(2.0 * radius)) + 3;
        for (int64_t y = first(center.y); y < first(center.y) + size; ++y) {
            for (int64_t x = first(center.x); x < first(center.x) + size; ++x) {
                if (x < 0 || y < 0 || x >= image_.width || y >= image_.height) continue;
                const auto column = static_cast<uint32_t>(x), row = static_cast<uint32_t>(y);
                const double distance = glm::distance(center, glm::dvec2(column + 0.5, row + 0.5));
                const auto cover =
                    static_cast<float>(std::clamp(radius - distance + 0.5, 0.0, 1.0));
                const auto rim = static_cast<float>(std::clamp(distance - radius + 2.0, 0.0, 1.0));
                const glm::vec3 inside = glm::mix(color, 0.25f * color, rim);
                set(column, row, glm::mix(color_at(column, row), inside, cover));
            }
        }
    }

    /// From the least light through walls to the most.
    void draw_balls(const Panel& panel) {
        const auto& places = report_.places;
        std::vector<uint32_t> order(places.size());
        std::iota(order.begin(), order.end(), 0u);
        std::ranges::stable_sort(order, [&](uint32_t a, uint32_t b) {
            return places[a].through_walls() < places[b].through_walls();
        });
        const double area = 1.0 * panel.width() * panel.height();
        const double radius =
            std::clamp(0.3 * std::sqrt(area / static_cast<double>(places.size())), 2.0, 7.0);
        for (const uint32_t i : order) {
            const double share = places[i].through_walls() / report_.mean_light;
            const bool is_none = share < 0.001;
            draw_ball(panel.point(places[i].position) + glm::dvec2(0.0, panel.top),
                      is_none ? 0.55 * radius : radius, leak_color(share));
        }
    }

    void draw_title(const Panel& panel) {
        char title[80];
        std::snprintf(title, sizeof title, panel.view.title, panel.view.cut);
        draw_text(image_, 8.0f, static_cast<float>(panel.top - kTextHeight) + 6.0f, title);
    }

    void draw_legend() {
        const double y = image_.height - 0.5 * kTextHeight;
        const auto text_y = static_cast<float>(y - 7.0);
        draw_text(image_, 8.0f, text_y, "light through walls:");
        double x = 250.0;
        constexpr double kLetter = 11.0;
        for (const auto& [share, name] :
             {std::pair{0.0, "none"}, {0.01, "1 %"}, {0.1, "10 %"}, {1.0, "100 % of the mean"}}) {
            draw_ball({x, y}, 6.0, leak_color(share));
            draw_text(image_, static_cast<float>(x) + 12.0f, text_y, name);
            x += 40.0 + kLetter * static_cast<double>(std::string_view(name).size());
        }
    }

    const SceneShader& shader_;
    const TraceScene& traced_;
    const LeakReport& report_;
    Panel plan_, section_;
    Image8 image_;
};

}  // namespace

glm::vec3 leak_color(double share) {
    constexpr std::array<glm::vec3, 4> kColors{glm::vec3(0.62f), glm::vec3(1.0f, 0.62f, 0.1f),
                                               glm::vec3(0.88f, 0.08f, 0.06f), glm::vec3(1.0f)};
    const double grade = std::clamp(std::log10(std::max(share, 1e-3)) + 3.0, 0.0, 3.0);
    const auto below = std::min<size_t>(static_cast<size_t>(grade), 2);
    const auto t = static_cast<float>(grade - static_cast<double>(below));
    return glm::mix(kColors[below], kColors[below + 1], t);
}

Result<Image8> draw_leaks(const Scene& scene, const ProbeVolumeView& volume,
                          const LeakReport& report, uint32_t thread_count) {
    const auto shader = SceneShader::make(scene, volume);
    if (!shader) return shader.error();
    const auto traced = TraceScene::make_static(scene);
    if (!traced) return traced.error();
    return LeakPicture(*shader, *traced, report).draw(thread_count);
}

}  // namespace tetralight
