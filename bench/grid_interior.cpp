// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/grid_interior.h>

#include <glm/geometric.hpp>
#include <utility>

#include <tetralight/bench/scene_parts.h>

namespace tetralight::bench {
namespace {

constexpr double kLong = 10.0, kHigh = 3.0, kDeep = 5.0, kWall = 0.2;
constexpr double kDoorWidth = 0.8, kDoorTop = 2.1;
constexpr double kSill = 0.9, kLintel = 2.2;
const glm::dvec3 kPlaster(0.75, 0.72, 0.68), kWood(0.5, 0.35, 0.22), kMetal(0.35);

/// A hole in a wall, from `begin` to `end` along the wall.
struct Opening {
    double begin = 0.0, end = 0.0;
    double sill = 0.0, lintel = 0.0;
};

constexpr Opening kGlassWindow{1.2, 2.8, kSill, kLintel};
constexpr Opening kBarredWindow{8.0, 9.4, kSill, kLintel};

class InteriorBuilder {
  public:
    Scene build() {
        add_shell();
        add_glass();
        add_bars();
        furnish();
        scene_.environment.radiance = {0.5f, 0.7f, 1.0f};
        Light sun;
        sun.intensity = glm::vec3(9.0f, 8.5f, 7.5f);
        sun.direction = glm::normalize(glm::vec3(0.3f, -0.8f, 1.0f));  // in through both windows
        scene_.lights.push_back(sun);
        scene_.light_names.emplace_back("sun");
        return std::move(scene_);
    }

  private:
    void add(const WorldBox& box, const glm::dvec3& albedo) {
        Material material;
        material.base_color = glm::vec4(glm::vec3(albedo), 1.0f);
        material.metallic = 0.0f;
        add_mesh(scene_, box_mesh(box), material);
    }

    /// The parts of a wall around its opening. `wall` is the whole wall; it runs along `axis`.
    void add_wall(const WorldBox& wall, int axis, const Opening& opening) {
        const auto part = [&](double from, double to, double low, double high) {
            if (to <= from || high <= low) return;
            WorldBox box = wall;
            box.min[axis] = from;
            box.max[axis] = to;
            box.min.y = low;
            box.max.y = high;
            add(box, kPlaster);
        };
        part(wall.min[axis], opening.begin, wall.min.y, wall.max.y);
        part(opening.end, wall.max[axis], wall.min.y, wall.max.y);
        part(opening.begin, opening.end, wall.min.y, opening.sill);
        part(opening.begin, opening.end, opening.lintel, wall.max.y);
    }

    void add_shell() {
        const double w = kWall;
        add({{-w, -w, -w}, {kLong + w, 0.0, kDeep + w}}, kWood);
        add({{-w, kHigh, -w}, {kLong + w, kHigh + w, kDeep + w}}, kPlaster);
        add({{-w, 0.0, kDeep}, {kLong + w, kHigh, kDeep + w}}, kPlaster);
        add({{-w, 0.0, 0.0}, {0.0, kHigh, kDeep}}, kPlaster);
        add({{kLong, 0.0, 0.0}, {kLong + w, kHigh, kDeep}}, kPlaster);
        constexpr double kBetweenWindows = 5.0;
        add_wall({{-w, 0.0, -w}, {kBetweenWindows, kHigh, 0.0}}, 0, kGlassWindow);
        add_wall({{kBetweenWindows, 0.0, -w}, {kLong + w, kHigh, 0.0}}, 0, kBarredWindow);
        add_wall({{4.0, 0.0, 0.0}, {4.0 + w, kHigh, kDeep}}, 2,
                 {3.4, 3.4 + kDoorWidth, 0.0, kDoorTop});
        add_wall({{7.0, 0.0, 0.0}, {7.0 + w, kHigh, kDeep}}, 2,
                 {1.0, 1.0 + kDoorWidth, 0.0, kDoorTop});
    }

    /// A pane near the outside of the wall.
    void add_glass() {
        const auto& [begin, end, sill, lintel] = kGlassWindow;
        Material glass;
        glass.base_color = glm::vec4(0.9f, 0.95f, 1.0f, 0.1f);
        glass.metallic = 0.0f;
        glass.alpha_mode = AlphaMode::Blend;
        glass.is_double_sided = true;
        Mesh pane;
        append_quad(pane, {begin, sill, -kWall + 0.02}, {end - begin, 0.0, 0.0},
                    {0.0, lintel - sill, 0.0});
        add_mesh(scene_, std::move(pane), glass);
    }

    /// Bars flush with the outside of the wall.
    void add_bars() {
        constexpr double kBar = 0.05, kStep = 0.12;
        const auto& [begin, end, sill, lintel] = kBarredWindow;
        for (int i = 0; begin + i * kStep < end; ++i) {
            const double x = begin + i * kStep;
            add({{x, sill, -kWall}, {x + kBar, lintel, -kWall + kBar}}, kMetal);
        }
    }

    void add_table(const glm::dvec3& corner, double length) {
        constexpr double kWidth = 0.8, kTop = 0.75, kThick = 0.05, kLeg = 0.06;
        add({corner + glm::dvec3(0.0, kTop - kThick, 0.0),
             corner + glm::dvec3(length, kTop, kWidth)},
            kWood);
        for (const double x : {0.0, length - kLeg}) {
            for (const double z : {0.0, kWidth - kLeg}) {
                const glm::dvec3 foot = corner + glm::dvec3(x, 0.0, z);
                add({foot, foot + glm::dvec3(kLeg, kTop - kThick, kLeg)}, kWood);
            }
        }
    }

    /// Boards between two sides, open at the front and the back, along x.
    void add_shelf(const glm::dvec3& corner, double length) {
        constexpr double kTall = 2.0, kWidth = 0.35, kBoard = 0.03, kStep = 0.4;
        for (const double x : {0.0, length - kBoard}) {
            const glm::dvec3 foot = corner + glm::dvec3(x, 0.0, 0.0);
            add({foot, foot + glm::dvec3(kBoard, kTall, kWidth)}, kWood);
        }
        for (int i = 0; i <= 4; ++i) {
            const glm::dvec3 board = corner + glm::dvec3(kBoard, 0.1 + i * kStep, 0.0);
            add({board, board + glm::dvec3(length - 2.0 * kBoard, kBoard, kWidth)}, kWood);
        }
    }

    void add_column(double x, double z) {
        constexpr double kSide = 0.3;
        add({{x, 0.0, z}, {x + kSide, kHigh, z + kSide}}, kPlaster);
    }

    void furnish() {
        add_table({1.2, 0.0, 1.8}, 1.6);
        add_table({5.0, 0.0, 3.2}, 1.2);
        add_table({8.0, 0.0, 2.4}, 1.4);
        add_shelf({0.6, 0.0, kDeep - 0.35}, 2.4);
        add_shelf({4.5, 0.0, 0.02}, 2.0);
        add_shelf({7.6, 0.0, kDeep - 0.37}, 1.8);
        add_column(3.0, 0.8);
        add_column(5.4, 2.0);
        add_column(9.2, 3.6);
        add({{0.1, 0.0, 3.0}, {0.7, 0.9, 4.2}}, {0.3, 0.4, 0.55});    // a chest
        add({{4.3, 0.0, 2.0}, {4.9, 0.45, 2.9}}, {0.55, 0.25, 0.2});  // a bench
        add({{9.3, 0.0, 0.3}, {9.9, 1.6, 1.1}}, {0.4, 0.5, 0.35});    // a cupboard
    }

    Scene scene_;
};

}  // namespace

Scene furnished_interior() {
    return InteriorBuilder().build();
}

glm::dvec3 place_in_interior() {
    return {2.0, 1.5, 3.5};
}

}  // namespace tetralight::bench
