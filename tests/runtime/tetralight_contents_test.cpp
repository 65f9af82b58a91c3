// SPDX-License-Identifier: Apache-2.0
// Arrays, details and lights of a volume through the C API.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/probes/recombine.h>
#include <tetralight/runtime/tetralight.h>
#include "tests/support/layered_volume.h"

namespace tetralight {
namespace {

/// A volume that has every array.
ProbeVolume make_full_volume() {
    ProbeVolume volume = test::make_layered_volume(40, 2);
    const size_t count = volume.positions.size();
    volume.info.world_origin = {100.0, -20.0, 3.0};
    volume.occlusion.assign(count, glm::vec4(0.25f, 1.0f, 0.0f, 0.5f));
    volume.validity.assign(count, 0.75f);
    volume.health.assign(count, {0.01f, 2.0f, {0.1f, 0.0f, -0.1f}, 1});
    volume.rendering_layers.assign(count, 0b1001);
    volume.layer_errors.assign(2 * count, 0.125f);
    volume.sky.resize(1);
    volume.sky[0].coefficients[15] = {1.0f, 2.0f, 3.0f};
    volume.sources = {{0, 7, 1}};
    volume.group_names = "hall\n";
    volume.metadata = "{\"samples\":16}";
    volume.lights.resize(2);
    volume.light_names = "sun\nlamp\n";
    volume.lights[1].type = LightType::Spot;
    volume.lights[1].mode = LightMode::Baked;
    volume.lights[1].falloff = LightFalloff::Linear;
    volume.lights[1].intensity = {1.0f, 2.0f, 3.0f};
    volume.lights[1].position = {4.0f, 5.0f, 6.0f};
    volume.lights[1].direction = {0.0f, -1.0f, 0.0f};
    volume.lights[1].range = 7.0f;
    volume.lights[1].radius = 0.25f;
    volume.light_states = {{MixedLighting::Shadowmask, 2, 0, 0}, {}};
    volume.occlusion_lights.assign(count, {kNoIndex, kNoIndex, 0, kNoIndex});
    make_compact_probes(volume);
    return volume;
}

class CApiContents : public testing::Test {
  protected:
    CApiContents() {
        exact_positions(data);
        const auto bytes = probe_file_bytes(data.view());
        EXPECT_EQ(tetralight_open_memory(bytes.data(), bytes.size(), &volume, &error),
                  TETRALIGHT_OK)
            << error.message;
    }

    ~CApiContents() override { tetralight_close(volume); }

    CApiContents(const CApiContents&) = delete;
    CApiContents& operator=(const CApiContents&) = delete;

    /// World positions that agree with the origin.
    static void exact_positions(ProbeVolume& volume) {
        volume.exact_positions.clear();
        for (const glm::vec3& p : volume.positions) {
            volume.exact_positions.push_back(volume.info.world_origin + glm::dvec3(p));
        }
    }

    tetralight_const_array array_of(uint32_t which) {
        tetralight_const_array array{};
        EXPECT_EQ(tetralight_get_array(volume, which, &array, &error), TETRALIGHT_OK)
            << error.message;
        return array;
    }

    template <class Element>
    void expect_array(uint32_t which, const std::vector<Element>& expected) {
        const tetralight_const_array array = array_of(which);
        ASSERT_EQ(array.size, expected.size() * sizeof(Element)) << which;
        EXPECT_EQ(array.stride, sizeof(Element)) << which;
        EXPECT_EQ(std::memcmp(array.data, expected.data(), array.size), 0) << which;
    }

    /// An array with gaps holds `expected` as each element.
    template <class Value>
    void expect_values(uint32_t which, size_t count, size_t stride, const Value& expected) {
        const tetralight_const_array array = array_of(which);
        EXPECT_EQ(array.stride, stride) << which;
        ASSERT_EQ((array.size - sizeof(Value)) / array.stride + 1, count) << which;
        const auto* bytes = static_cast<const std::byte*>(array.data);
        for (size_t i = 0; i < count; ++i) {
            EXPECT_EQ(std::memcmp(bytes + i * stride, &expected, sizeof expected), 0) << which;
        }
    }

    ProbeVolume data = make_full_volume();
    tetralight_volume* volume = nullptr;
    tetralight_error error{};
};

TEST_F(CApiContents, HasTheArraysOfTheVolume) {
    expect_array(TETRALIGHT_ARRAY_POSITIONS, data.positions);
    expect_array(TETRALIGHT_ARRAY_EXACT_POSITIONS, data.exact_positions);
    expect_array(TETRALIGHT_ARRAY_IRRADIANCE, data.irradiance);
    expect_array(TETRALIGHT_ARRAY_HALVES, data.compact);
    expect_array(TETRALIGHT_ARRAY_OCCLUSION, data.occlusion);
    expect_array(TETRALIGHT_ARRAY_VALIDITY, data.validity);
    expect_array(TETRALIGHT_ARRAY_RENDERING_LAYERS, data.rendering_layers);
    expect_array(TETRALIGHT_ARRAY_HULL_RAYS, data.hull_rays);
    expect_array(TETRALIGHT_ARRAY_SOURCES, data.sources);
    expect_array(TETRALIGHT_ARRAY_LAYER_IRRADIANCE, data.layer_irradiance);
    expect_array(TETRALIGHT_ARRAY_LAYER_ERRORS, data.layer_errors);
    expect_array(TETRALIGHT_ARRAY_SKY, data.sky);
}

TEST_F(CApiContents, HasTheTextsOfTheVolume) {
    const auto text = [&](uint32_t which) {
        const tetralight_const_array array = array_of(which);
        return std::string(static_cast<const char*>(array.data), array.size);
    };
    EXPECT_EQ(text(TETRALIGHT_ARRAY_GROUP_NAMES), data.group_names);
    EXPECT_EQ(text(TETRALIGHT_ARRAY_LIGHT_NAMES), data.light_names);
    EXPECT_EQ(text(TETRALIGHT_ARRAY_LAYER_NAMES), data.layer_names);
    EXPECT_EQ(text(TETRALIGHT_ARRAY_METADATA), data.metadata);
}

TEST_F(CApiContents, HasThePartsOfElementsWithStrides) {
    const size_t count = data.positions.size();
    expect_values(TETRALIGHT_ARRAY_STANDARD_ERROR, count, sizeof(ProbeHealth), 0.01f);
    expect_values(TETRALIGHT_ARRAY_SURFACE_DISTANCE, count, sizeof(ProbeHealth), 2.0f);
    expect_values(TETRALIGHT_ARRAY_VIRTUAL_OFFSET, count, sizeof(ProbeHealth),
                  glm::vec3(0.1f, 0.0f, -0.1f));
    expect_values(TETRALIGHT_ARRAY_DILATED, count, sizeof(ProbeHealth), uint32_t{1});
    for (const bool is_vertices : {true, false}) {
        const auto array = array_of(is_vertices ? TETRALIGHT_ARRAY_CELL_VERTICES
                                                : TETRALIGHT_ARRAY_CELL_NEIGHBORS);
        ASSERT_EQ((array.size - 16) / array.stride + 1, data.cells.size());
        for (size_t i = 0; i < data.cells.size(); ++i) {
            const auto& expected = is_vertices ? data.cells[i].vertices : data.cells[i].neighbors;
            const auto* bytes = static_cast<const std::byte*>(array.data) + i * array.stride;
            EXPECT_EQ(std::memcmp(bytes, &expected, 16), 0) << i;
        }
    }
}

TEST_F(CApiContents, AnArrayThatIsMissingIsAnError) {
    ProbeVolume bare = test::make_lit_volume(test::random_positions(10, 1));
    bare.exact_positions.clear();
    const auto bytes = probe_file_bytes(bare.view());
    tetralight_volume* other = nullptr;
    ASSERT_EQ(tetralight_open_memory(bytes.data(), bytes.size(), &other, &error), TETRALIGHT_OK);
    tetralight_const_array array{&error, 1, 2};
    for (const uint32_t which :
         {TETRALIGHT_ARRAY_EXACT_POSITIONS, TETRALIGHT_ARRAY_HALVES, TETRALIGHT_ARRAY_VALIDITY,
          TETRALIGHT_ARRAY_VIRTUAL_OFFSET, TETRALIGHT_ARRAY_SKY, TETRALIGHT_ARRAY_METADATA}) {
        EXPECT_EQ(tetralight_get_array(other, which, &array, &error), TETRALIGHT_NOT_THERE);
        EXPECT_EQ(array.data, &error) << "a call that fails changes nothing";
    }
    EXPECT_STREQ(error.message, "the volume does not hold metadata");
    EXPECT_EQ(tetralight_get_array(other, TETRALIGHT_ARRAY_METADATA + 1, &array, &error),
              TETRALIGHT_BAD_VALUE);
    EXPECT_EQ(tetralight_get_array(nullptr, 0, &array, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_get_array(other, 0, nullptr, &error), TETRALIGHT_BAD_POINTER);
    tetralight_close(other);
}

TEST_F(CApiContents, IrradianceFollowsTheWeightsOfLayers) {
    const float weights[] = {0.0f, 2.0f};
    ASSERT_EQ(tetralight_recombine(volume, weights, 2, &error), TETRALIGHT_OK);
    ASSERT_TRUE(recombine(data, std::vector<float>{0.0f, 2.0f}));
    expect_array(TETRALIGHT_ARRAY_IRRADIANCE, data.irradiance);
    expect_array(TETRALIGHT_ARRAY_HALVES, data.compact);
    expect_array(TETRALIGHT_ARRAY_POSITIONS, data.positions);
}

TEST_F(CApiContents, DetailsAreThoseOfTheVolume) {
    tetralight_details details{};
    ASSERT_EQ(tetralight_get_details(volume, &details, &error), TETRALIGHT_OK);
    for (int i = 0; i < 3; ++i) {
        const auto below = [&](const glm::vec3& a, const glm::vec3& b) { return a[i] < b[i]; };
        const auto [low, high] = std::ranges::minmax_element(data.positions, below);
        EXPECT_EQ(details.world_origin[i], data.info.world_origin[i]);
        EXPECT_EQ(details.low[i], data.info.world_origin[i] + (*low)[i]);
        EXPECT_EQ(details.high[i], data.info.world_origin[i] + (*high)[i]);
    }
    EXPECT_EQ(std::memcmp(details.ambient, &data.info.ambient, sizeof details.ambient), 0);
    EXPECT_EQ(details.half_scale, data.info.compact_scale);
    EXPECT_EQ(details.knows_walls, 0u);
    EXPECT_EQ(details.can_relight_sky, 0u);
    EXPECT_EQ(details.can_relight_sun, 0u);
    EXPECT_EQ(details.light_count, 2u);
    EXPECT_EQ(tetralight_get_details(nullptr, &details, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_get_details(volume, nullptr, &error), TETRALIGHT_BAD_POINTER);
}

TEST_F(CApiContents, DetailsOfNoProbesAreZero) {
    const auto bytes = probe_file_bytes(ProbeVolume{}.view());
    tetralight_volume* empty = nullptr;
    ASSERT_EQ(tetralight_open_memory(bytes.data(), bytes.size(), &empty, &error), TETRALIGHT_OK)
        << error.message;
    tetralight_details details{};
    details.low[1] = details.half_scale = -7.0f;
    ASSERT_EQ(tetralight_get_details(empty, &details, &error), TETRALIGHT_OK);
    EXPECT_EQ(details.low[1], 0.0);
    EXPECT_EQ(details.high[2], 0.0);
    EXPECT_EQ(details.half_scale, 0.0f);
    tetralight_close(empty);
}

TEST_F(CApiContents, HasTheLightsOfTheScene) {
    tetralight_scene_light light{};
    ASSERT_EQ(tetralight_get_scene_light(volume, 0, &light, &error), TETRALIGHT_OK);
    EXPECT_STREQ(light.name, "sun");
    EXPECT_EQ(light.type, TETRALIGHT_LIGHT_DIRECTIONAL);
    EXPECT_EQ(light.mode, TETRALIGHT_LIGHT_MIXED);
    EXPECT_EQ(light.channel, 2u);
    EXPECT_EQ(light.weight, light_weight(data.view(), 0));
    ASSERT_EQ(tetralight_get_scene_light(volume, 1, &light, &error), TETRALIGHT_OK);
    EXPECT_STREQ(light.name, "lamp");
    EXPECT_EQ(light.type, TETRALIGHT_LIGHT_SPOT);
    EXPECT_EQ(light.mode, TETRALIGHT_LIGHT_BAKED);
    EXPECT_EQ(light.falloff, TETRALIGHT_FALLOFF_LINEAR);
    EXPECT_EQ(light.channel, TETRALIGHT_NO_CELL);
    EXPECT_EQ(light.intensity[2], 3.0f);
    EXPECT_EQ(light.position[1], 5.0f);
    EXPECT_EQ(light.direction[1], -1.0f);
    EXPECT_EQ(light.range, 7.0f);
    EXPECT_EQ(light.cos_outer_cone, data.lights[1].cos_outer_cone);
    EXPECT_EQ(light.radius, 0.25f);
    EXPECT_EQ(light.tangent[0], 1.0f);
}

TEST_F(CApiContents, ALightThatIsMissingIsAnError) {
    tetralight_scene_light light{};
    EXPECT_EQ(tetralight_get_scene_light(volume, 2, &light, &error), TETRALIGHT_NOT_THERE);
    EXPECT_STREQ(error.message, "there is no light 2 of 2");
    EXPECT_EQ(tetralight_get_scene_light(volume, 0, nullptr, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_get_scene_light(nullptr, 0, &light, &error), TETRALIGHT_BAD_POINTER);
}

}  // namespace
}  // namespace tetralight
