// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/grid_scenes.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/base/error_text.h>
#include <tetralight/bench/grid_interior.h>
#include <tetralight/bench/leak_scenes.h>
#include <tetralight/bench/scene_parts.h>

namespace tetralight::bench {
namespace {

constexpr double kRoom = 4.0, kStorey = 3.0, kWall = 0.15, kSlab = 0.25;
constexpr int kRoomsX = 3, kRoomsZ = 2, kStoreys = 2;

class HouseBuilder {
  public:
    Scene build() {
        const double wide = kRoomsX * kRoom, deep = kRoomsZ * kRoom;
        add({{-3, -0.5, -3}, {wide + 3, 0, deep + 3}}, {0.25, 0.4, 0.2});
        for (int storey = 0; storey < kStoreys; ++storey) add_storey(storey);
        const double top = kStoreys * kStorey;
        add({{-0.3, top, -0.3}, {wide + 0.3, top + kSlab, deep + 0.3}}, {0.5, 0.3, 0.25});
        scene_.environment.radiance = {0.5f, 0.7f, 1.0f};
        Light sun;
        sun.intensity = glm::vec3(9.0f, 8.5f, 7.5f);
        sun.direction = glm::normalize(glm::vec3(0.5f, -1.0f, 0.6f));
        scene_.lights.push_back(sun);
        scene_.light_names.emplace_back("sun");
        return std::move(scene_);
    }

  private:
    void add(const WorldBox& box, const glm::dvec3& albedo, const glm::vec3& emission = {}) {
        Material material;
        material.base_color = glm::vec4(glm::vec3(albedo), 1.0f);
        material.metallic = 0.0f;
        material.emission = emission;
        add_mesh(scene_, box_mesh(box), material);
    }

    /// A wall from `begin` to `end` along an axis (0 or 2), with one opening at its center.
    struct Wall {
        int axis = 0;
        double at = 0.0;  ///< on the other axis
        double begin = 0.0, end = 0.0, floor = 0.0;
        double width = 0.0, sill = 0.0, lintel = 0.0;  ///< of the opening
    };

    void add_wall(const Wall& wall) {
        const double middle = 0.5 * (wall.begin + wall.end);
        const double left = middle - 0.5 * wall.width, right = middle + 0.5 * wall.width;
        const double ceiling = wall.floor + kStorey;
        const auto part = [&](double from, double to, double low, double high) {
            if (to - from < 1e-6 || high - low < 1e-6) return;
            WorldBox box;
            const int other = 2 - wall.axis;
            box.min[wall.axis] = from;
            box.max[wall.axis] = to;
            box.min[other] = wall.at - 0.5 * kWall;
            box.max[other] = wall.at + 0.5 * kWall;
            box.min.y = low;
            box.max.y = high;
            add(box, {0.75, 0.72, 0.68});
        };
        part(wall.begin, left, wall.floor, ceiling);
        part(right, wall.end, wall.floor, ceiling);
        part(left, right, wall.floor, wall.floor + wall.sill);
        part(left, right, wall.floor + wall.lintel, ceiling);
    }

    void add_storey(int storey) {
        const double floor = storey * kStorey;
        for (int x = 0; x <= kRoomsX; ++x) {
            for (int z = 0; z < kRoomsZ; ++z) add_room_wall(2, x, z, x % kRoomsX == 0, floor);
        }
        for (int z = 0; z <= kRoomsZ; ++z) {
            for (int x = 0; x < kRoomsX; ++x) add_room_wall(0, z, x, z % kRoomsZ == 0, floor);
        }
        for (int x = 0; x < kRoomsX; ++x) {
            for (int z = 0; z < kRoomsZ; ++z) furnish(storey, x, z);
        }
        if (storey > 0) add_slab(floor);
    }

    void add_room_wall(int axis, int line, int room, bool is_outside, double floor) {
        Wall wall{axis, line * kRoom, room * kRoom, (room + 1) * kRoom, floor, 0.9, 0.0, 2.1};
        if (is_outside) {
            wall.width = 1.6;
            wall.sill = 0.9;
        }
        add_wall(wall);
    }

    /// The floor of the upper storey, without the stairwell in the first room.
    void add_slab(double floor) {
        const double wide = kRoomsX * kRoom, deep = kRoomsZ * kRoom, low = floor - kSlab;
        const glm::dvec3 wood(0.55, 0.42, 0.3);
        add({{1.5, low, -0.05}, {wide + 0.05, floor, deep + 0.05}}, wood);
        add({{-0.05, low, 2.8}, {1.5, floor, deep + 0.05}}, wood);
        add({{-0.05, low, -0.05}, {1.5, floor, 0.4}}, wood);
    }

    void furnish(int storey, int x, int z) {
        const glm::dvec3 corner(x * kRoom, storey * kStorey, z * kRoom);
        const int number = (storey * kRoomsX + x) * kRoomsZ + z;
        const glm::dvec3 table = corner + glm::dvec3(2.3, 0.0, 2.3);
        add({table, table + glm::dvec3(1.2, 0.75, 0.7)},
            {0.3 + 0.04 * number, 0.5 - 0.03 * number, 0.3});
        if (number % 2 != 0) return;
        const glm::dvec3 lamp = corner + glm::dvec3(1.7, 2.3, 1.7);
        add({lamp, lamp + glm::dvec3(0.5, 0.06, 0.5)}, glm::dvec3(0.5),
            glm::vec3(8.0f, 6.0f, 3.5f));
    }

    Scene scene_;
};

WorldBox bounds_of(const Scene& scene) {
    const auto bounds =
        scene_bounds(scene, [](const MeshInstance& instance) { return instance.contributes_gi; });
    require(bounds.has_value(), "scene with bounds");
    return *bounds;
}

GridSubject read_subject(const std::string& name, const std::string& path) {
    auto scene = read_gltf(path);
    require(bool(scene), scene ? "" : error_text(scene.error()));
    GridSubject subject{name, std::move(*scene), {}, {}};
    if (subject.scene.lights.empty() && subject.scene.environment.radiance == glm::vec3(0.0f)) {
        subject.scene.environment.radiance = {0.6f, 0.8f, 1.0f};
        Light sun;
        sun.intensity = glm::vec3(8.0f, 7.5f, 6.5f);
        sun.direction = glm::normalize(glm::vec3(0.3f, -1.0f, 0.2f));
        subject.scene.lights.push_back(sun);
        subject.scene.light_names.emplace_back("sun");
    }
    subject.bounds = bounds_of(subject.scene);
    return subject;
}

GridSubject make_subject(const std::string& name, Scene scene, std::vector<glm::dvec3> from = {}) {
    GridSubject subject{name, std::move(scene), {}, std::move(from)};
    subject.bounds = bounds_of(subject.scene);
    return subject;
}

GridSubject rooms_subject() {
    constexpr float kThickness = 0.2f;
    const double x = 0.5 * (double{kRoomWide} + double{kThickness});
    const double y = 0.5 * double{kRoomHigh}, z = 0.5 * double{kRoomWide};
    return make_subject("rooms", two_rooms(kThickness), {{-x, y, z}, {x, y, z}});
}

}  // namespace

std::vector<GridSubject> grid_subjects(const Options& options) {
    std::vector<GridSubject> subjects;
    subjects.push_back(
        read_subject("courtyard", TETRALIGHT_SOURCE_DIR "/examples/scenes/courtyard.glb"));
    subjects.push_back(make_subject("house", HouseBuilder().build()));
    subjects.push_back(rooms_subject());
    subjects.push_back(make_subject("interior", furnished_interior(), {place_in_interior()}));
    if (options.scene) subjects.push_back(read_subject(kExternalScene, *options.scene));
    return subjects;
}

}  // namespace tetralight::bench
