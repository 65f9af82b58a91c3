// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include <tetralight/bake/scene/scene.h>
#include "tests/support/scenes.h"

namespace tetralight::test {

/// A scene and positions in its free space.
struct RandomScene {
    Scene scene;
    std::vector<glm::dvec3> probes;
};

/// Builds small scenes of everything that a bake knows: a room with openings (some with panes or
/// cut-out screens in them) or open ground with screens, solids, lights of every type, emissive
/// surfaces, and a sky, constant or with a sun in its image.
///
/// Lights and emitters keep a distance from surfaces, so that the light varies little enough for
/// the means of some ten thousand paths to be normally distributed.
class RandomSceneBuilder {
  public:
    explicit RandomSceneBuilder(uint64_t seed) : engine_(seed) {}

    RandomScene build(bool is_room, size_t probe_count) {
        size_ = {between(3.0f, 5.0f), between(2.4f, 3.2f), between(3.0f, 5.0f)};
        for (int i = 0; i < 3; ++i) add_texture();
        add_quad(scene_, material(), {-20, -0.1f, -20}, {0, 0, 40}, {40, 0, 0});
        is_room ? add_room() : add_screens();
        const int solids = 1 + pick(3);
        for (int i = 0; i < solids; ++i) add_solid();
        add_sky(is_room);
        add_lights();
        if (chance(0.5f) || scene_.lights.empty()) add_panel();
        if (chance(0.3f)) add_lamp();
        RandomScene result;
        for (size_t i = 0; i < probe_count; ++i) {
            result.probes.emplace_back(0.5f * size_.x + between(-0.9f, 0.9f), between(0.9f, 1.8f),
                                       0.5f * size_.z + between(-0.9f, 0.9f));
        }
        result.scene = std::move(scene_);
        return result;
    }

  private:
    float between(float low, float high) {
        return low + (high - low) * (static_cast<float>(engine_() >> 40) * 0x1p-24f);
    }

    int pick(int count) {
        return std::min(count - 1, static_cast<int>(between(0, static_cast<float>(count))));
    }

    bool chance(float probability) { return between(0, 1) < probability; }

    glm::vec3 color(float low, float high) {
        const float r = between(low, high), g = between(low, high), b = between(low, high);
        return {r, g, b};
    }

    /// 4 × 4 colours, about a third of them cut out.
    void add_texture() {
        Texture texture;
        texture.image = {4, 4, {}};
        for (int i = 0; i < 16; ++i) {
            const auto channel = [&] { return static_cast<uint8_t>(60 + pick(190)); };
            const uint8_t r = channel(), g = channel(), b = channel();
            texture.image.pixels.push_back(
                {r, g, b, static_cast<uint8_t>(chance(0.35f) ? 0 : 255)});
        }
        scene_.textures.push_back(texture);
    }

    /// An opaque material of any colour.
    Material material() {
        Material result = diffuse(color(0.3f, 0.8f));
        if (chance(0.3f)) result.base_color_texture.texture = static_cast<uint32_t>(pick(3));
        if (chance(0.2f)) {
            result.metallic = 1.0f;
            result.roughness = between(0.1f, 1.0f);
        }
        result.is_double_sided = chance(0.5f);
        return result;
    }

    Material pane() {
        Material result = diffuse(color(0.1f, 0.6f));
        result.base_color.a = between(0.2f, 0.6f);
        result.alpha_mode = AlphaMode::Blend;
        result.is_double_sided = chance(0.7f);
        return result;
    }

    Material cut_out() {
        Material result = diffuse(color(0.3f, 0.8f));
        result.base_color_texture.texture = static_cast<uint32_t>(pick(3));
        result.alpha_mode = AlphaMode::Mask;
        result.is_double_sided = true;
        return result;
    }

    /// A wall from `corner` along `u` and `v`, of lengths `width` and `height`, whose front is
    /// where u × v points to.
    void add_wall(glm::vec3 corner, glm::vec3 u, glm::vec3 v, float width, float height) {
        Material wall = material();
        wall.is_double_sided = true;
        const auto part = [&](float left, float right, float low, float high) {
            add_quad(scene_, wall, corner + left * u + low * v, (right - left) * u,
                     (high - low) * v);
        };
        if (chance(0.45f)) return part(0, width, 0, height);
        const float left = between(0.3f, 0.4f) * width, right = left + between(0.7f, 1.2f);
        const float low = between(0.2f, 0.35f) * height, high = low + between(0.7f, 1.2f);
        part(0, left, 0, height);
        part(right, width, 0, height);
        part(left, right, 0, low);
        part(left, right, high, height);
        const glm::vec3 sill = corner + left * u + low * v;
        const int filling = pick(3);
        if (filling == 0) return;
        add_quad(scene_, filling == 1 ? pane() : cut_out(), sill, (right - left) * u,
                 (high - low) * v);
    }

    void add_room() {
        const auto [x, y, z] = std::tuple(size_.x, size_.y, size_.z);
        add_quad(scene_, material(), {0, 0, 0}, {0, 0, z}, {x, 0, 0});
        add_wall({0, y, 0}, {1, 0, 0}, {0, 0, 1}, x, z);
        add_wall({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, x, y);
        add_wall({x, 0, z}, {-1, 0, 0}, {0, 1, 0}, x, y);
        add_wall({0, 0, z}, {0, 0, -1}, {0, 1, 0}, z, y);
        add_wall({x, 0, 0}, {0, 0, 1}, {0, 1, 0}, z, y);
    }

    /// Free-standing walls, a pane and a cut-out screen.
    void add_screens() {
        add_wall({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, size_.x, size_.y);
        if (chance(0.7f)) add_wall({0, size_.y, 0}, {1, 0, 0}, {0, 0, 1}, size_.x, size_.z);
        add_quad(scene_, pane(), {0, 0, size_.z}, {0, 0, -2}, {0, 1.5f, 0});
        add_quad(scene_, cut_out(), {size_.x, 0, 0}, {0, 0, 2}, {0, 1.5f, 0});
    }

    /// A box that is turned about its vertical axis, in some scenes mirrored.
    void add_solid() {
        Scene scratch;
        add_box(scratch, {}, Facing::Outward, {-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f});
        const glm::dvec3 place(size_.x * between(0.2f, 0.8f), 0.0, size_.z * between(0.2f, 0.8f));
        glm::dvec3 scale(between(0.3f, 0.8f), between(0.2f, 0.7f), between(0.3f, 0.8f));
        if (chance(0.3f)) scale.x = -scale.x;
        MeshInstance& solid = add_mesh(scene_, material(), scratch.meshes[0]);
        const double angle = between(0, 6);
        solid.world_from_mesh = glm::translate(glm::dmat4(1.0), place) *
                                glm::rotate(glm::dmat4(1.0), angle, glm::dvec3(0, 1, 0)) *
                                glm::scale(glm::dmat4(1.0), scale);
    }

    /// Darker over open ground, where it would leave little for the lights.
    void add_sky(bool is_room) {
        const float strength = is_room ? 3.0f : 0.3f;
        Environment& sky = scene_.environment;
        sky.radiance = strength * color(0.2f, 1.0f);
        if (chance(0.3f)) sky.radiance = glm::vec3(0.0f);
        if (chance(0.5f)) return;
        sky.radiance = glm::vec3(strength);
        sky.rotation_radians = between(0, 6);
        sky.image = {16, 8, {}};
        for (int i = 0; i < 128; ++i) sky.image.pixels.push_back(color(0.1f, 0.5f));
        const int row = 1 + pick(3);
        sky.image.pixels[static_cast<size_t>(row * 16 + pick(16))] = color(20.0f, 40.0f);
    }

    /// Each type in about half of the scenes.
    void add_lights() {
        for (uint32_t type = 0; type < 5; ++type) {
            if (!chance(0.45f)) continue;
            const auto mode = static_cast<LightMode>(pick(2));
            Light& light = add_light(scene_, static_cast<LightType>(type), mode, color(1.0f, 4.0f));
            if (type == 0) light.intensity *= 3.0f;
            light.position = glm::vec3(0.5f) + (size_ - 1.0f) * color(0, 1);
            light.direction = glm::normalize(color(-1, 1) - glm::vec3(0, 1.5f, 0));
            const glm::vec3 side(light.direction.z, 0, -light.direction.x);
            light.tangent = glm::normalize(side);
            light.width = between(0.1f, 0.4f);
            light.height = between(0.1f, 0.4f);
            if (chance(0.6f) || type == 4) light.radius = between(0.05f, 0.15f);
            if (chance(0.4f)) light.range = between(2.0f, 6.0f);
            light.cos_inner_cone = 0.9f;
            light.cos_outer_cone = between(0.5f, 0.8f);
            light.indirect_multiplier = chance(0.3f) ? between(0.5f, 2.0f) : 1.0f;
        }
        if (!chance(0.2f)) return;
        add_light(scene_, LightType::Directional, LightMode::Realtime, glm::vec3(9.0f));
    }

    /// A panel below the ceiling, some with holes or of glass.
    void add_panel() {
        Material shining = chance(0.3f) ? cut_out() : chance(0.3f) ? pane() : material();
        shining.emission = color(1.0f, 4.0f);
        if (chance(0.3f)) shining.emission_texture.texture = static_cast<uint32_t>(pick(3));
        const glm::vec3 corner = glm::vec3(0.4f) + (size_ - 1.6f) * color(0, 1);
        add_quad(scene_, shining, {corner.x, size_.y - 0.4f, corner.z}, {between(0.4f, 0.8f), 0, 0},
                 {0, between(-0.2f, 0.2f), between(0.4f, 0.8f)});
    }

    /// A small bright quad that faces down or to the side.
    void add_lamp() {
        const glm::vec3 corner = glm::vec3(0.5f) + (size_ - 1.2f) * color(0, 1);
        const Material bright = diffuse(glm::vec3(0.0f), color(8.0f, 16.0f));
        const glm::vec3 last = chance(0.5f) ? glm::vec3(0, 0, 0.2f) : glm::vec3(0, 0.2f, 0);
        add_quad(scene_, bright, {corner.x, size_.y - 0.7f, corner.z}, {0.2f, 0, 0}, last);
    }

    std::mt19937_64 engine_;
    Scene scene_;
    glm::vec3 size_{0.0f};
};

/// Scene `index`: rooms and open ground in turn. The same on every machine.
inline RandomScene make_random_scene(uint64_t index, size_t probe_count) {
    return RandomSceneBuilder(index + 1).build(index % 2 == 0, probe_count);
}

}  // namespace tetralight::test
