// SPDX-License-Identifier: Apache-2.0
// Rooms behind each other, lit through one window.
#include <array>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <utility>

#include <tetralight/bake/bake_probes.h>
#include <tetralight/bench/bake_scenes.h>
#include <tetralight/bench/scene_parts.h>

namespace tetralight::bench {
namespace {

constexpr size_t kRooms = 5, kRoomProbes = 64;
constexpr double kLong = 5.0, kHigh = 3.0, kWide = 4.0;  // of a room, along x, y and z
constexpr double kWall = 0.2;

/// Parts of the building overlap by this much, so that there are no gaps between them.
constexpr double kOverlap = 0.1;

/// The lower corner of a room.
glm::dvec3 corner_of(size_t room) {
    return {static_cast<double>(room) * (kLong + kWall), 0.0, 0.0};
}

/// An opening in a wall across x.
struct Opening {
    glm::dvec2 low, high;  ///< y and z
};

/// 0.8 × 0.9 m.
constexpr Opening kWindow{{1.2, 1.5}, {2.1, 2.3}};

/// Neighbouring doors, 1 × 2.1 m, overlap in part.
constexpr std::array<double, kRooms - 1> kDoors{0.5, 1.2, 2.0, 1.3};

class RoomsBuilder {
  public:
    Scene build(bool has_window) {
        const double end = corner_of(kRooms).x - kWall;
        add({{-20, -0.5, -20}, {end + 20, -0.2, kWide + 20}}, {0.35, 0.32, 0.28});
        add({{-kWall, -0.3, -kWall}, {end + kWall, 0, kWide + kWall}}, {0.55, 0.5, 0.45});
        const double over = kHigh + kOverlap;
        add({{-kWall, kHigh, -kWall}, {end + kWall, kHigh + 0.3, kWide + kWall}}, kPlaster);
        add({{-kWall, -kOverlap, -kWall}, {end + kWall, over, 0}}, kPlaster);
        add({{-kWall, -kOverlap, kWide}, {end + kWall, over, kWide + kWall}}, kPlaster);
        add_wall(end, std::nullopt);
        add_wall(-kWall, has_window ? std::optional(kWindow) : std::nullopt);
        for (size_t i = 0; i < kDoors.size(); ++i) {
            add_wall(corner_of(i + 1).x - kWall,
                     Opening{{-kOverlap, kDoors[i]}, {2.1, kDoors[i] + 1.0}});
        }
        scene_.environment.radiance = {0.7f, 0.9f, 1.2f};
        return std::move(scene_);
    }

  private:
    static constexpr glm::dvec3 kPlaster{0.7, 0.68, 0.64};

    void add(const WorldBox& box, const glm::dvec3& albedo) {
        Material material;
        material.base_color = glm::vec4(glm::vec3(albedo), 1.0f);
        material.metallic = 0.0f;
        add_mesh(scene_, box_mesh(box), material);
    }

    /// A wall across x with its lower face at `x`.
    void add_wall(double x, const std::optional<Opening>& opening) {
        const double low = -kOverlap, high = kHigh + kOverlap;
        const double near = -kOverlap, far = kWide + kOverlap;
        if (!opening) return add({{x, low, near}, {x + kWall, high, far}}, kPlaster);
        const auto [from, to] = *opening;
        add({{x, low, near}, {x + kWall, high, from.y}}, kPlaster);
        add({{x, low, to.y}, {x + kWall, high, far}}, kPlaster);
        // Thinner, so that no faces coincide where the parts overlap.
        const double begin = x + 0.01, end = x + kWall - 0.01;
        const double left = from.y - kOverlap, right = to.y + kOverlap;
        add({{begin, to.x, left}, {end, high, right}}, kPlaster);
        if (from.x > 0.0) add({{begin, low, left}, {end, from.x, right}}, kPlaster);
    }

    Scene scene_;
};

/// The rooms are dark without their window.
void require_closed(const std::vector<glm::dvec3>& probes) {
    Scene scene = RoomsBuilder().build(false);
    scene.environment.radiance = glm::vec3(100.0f);
    const auto baked = bake_probes(scene, probes, {});
    require(bool(baked), "bake");
    for (const RadianceSh& light : baked->radiance) {
        require(light == RadianceSh{}, "rooms without a window are dark");
    }
}

}  // namespace

const char* rooms_name(RoomLight light) {
    return light == RoomLight::Sun ? "rooms" : "rooms_sky";
}

BakeSubject rooms_subject(RoomLight light) {
    BakeSubject subject{rooms_name(light), RoomsBuilder().build(true), {}};
    if (light == RoomLight::Sun) {
        Light sun;
        sun.intensity = glm::vec3(12.0f, 11.0f, 9.5f);
        sun.direction = glm::normalize(glm::vec3(1.0f, -0.85f, 0.15f));
        subject.scene.lights.push_back(sun);
        subject.scene.light_names.emplace_back("sun");
    }
    const glm::dvec3 size(kLong, kHigh, kWide), margin(0.3);
    const std::vector<glm::dvec3> places = random_positions(kRoomProbes, 4, 1.0);
    for (size_t i = 0; i < places.size(); ++i) {
        subject.probes.push_back(corner_of(i % kRooms) + margin +
                                 places[i] * (size - 2.0 * margin));
    }
    require_closed(subject.probes);
    return subject;
}

}  // namespace tetralight::bench
