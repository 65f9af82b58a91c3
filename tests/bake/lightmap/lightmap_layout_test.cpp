// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lightmap/lightmap_layout.h>

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include <tetralight/base/error_text.h>
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

const Material kGrey = test::diffuse(glm::vec3(0.5f));

glm::dmat4 moved(glm::dvec3 offset, double scale = 1.0) {
    return glm::scale(glm::translate(glm::dmat4(1.0), offset), glm::dvec3(scale));
}

/// Boxes of one mesh, with the given transforms.
Scene boxes(const std::vector<glm::dmat4>& transforms) {
    Scene scene;
    test::add_box(scene, kGrey, test::Facing::Outward, {0, 0, 0}, {1, 2, 3});
    const MeshInstance box = scene.instances[0];
    scene.instances.clear();
    for (const glm::dmat4& transform : transforms) {
        scene.instances.push_back(box);
        scene.instances.back().world_from_mesh = transform;
    }
    return scene;
}

LightmapLayout layout_of(const Scene& scene, const LightmapLayoutSettings& settings = {}) {
    const auto layout = make_lightmap_layout(scene, settings);
    EXPECT_TRUE(layout) << (layout ? "" : error_text(layout.error()));
    return layout ? *layout : LightmapLayout{};
}

std::string error_of(const Scene& scene, const LightmapLayoutSettings& settings) {
    const auto layout = make_lightmap_layout(scene, settings);
    return layout ? "" : error_text(layout.error());
}

/// Texels of a packing per square metre of a mesh's surface that faces along an axis.
double texels_per_meter(const LightmapPacking& packing, const Mesh& mesh, size_t triangle,
                        const glm::dmat4& transform) {
    const auto at = [&](size_t i) {
        return glm::dvec3(transform *
                          glm::dvec4(mesh.positions[mesh.indices[3 * triangle + i]], 1.0));
    };
    const glm::dvec3 u = at(1) - at(0), v = at(2) - at(0);
    const glm::vec2* uv = packing.charts.corner_uvs.data() + 3 * triangle;
    const glm::dvec2 a(uv[1] - uv[0]), b(uv[2] - uv[0]);
    return std::sqrt(std::abs(a.x * b.y - a.y * b.x) / glm::length(glm::cross(u, v)));
}

TEST(LightmapLayout, InstancesOfOneShapeShareAPackingAndHaveRectanglesOfTheirOwn) {
    const double angle = 0.7;
    const Scene scene =
        boxes({moved({0, 0, 0}), moved({9, 0, 0}),
               glm::rotate(moved({5, 1, 7}), angle, glm::normalize(glm::dvec3(1, 2, 3))),
               glm::scale(glm::dmat4(1.0), glm::dvec3(-1, 1, 1))});
    const LightmapLayout layout = layout_of(scene);
    EXPECT_EQ(layout.packings.size(), 1u);
    EXPECT_EQ(layout.page_count, 1u);
    const PackedCharts& charts = layout.packings[0].charts;
    for (size_t i = 0; i < 4; ++i) {
        for (size_t k = 0; k < i; ++k) {
            const PagePlace &a = layout.places[i].corner, &b = layout.places[k].corner;
            const bool are_apart = a.x + charts.width <= b.x || b.x + charts.width <= a.x ||
                                   a.y + charts.height <= b.y || b.y + charts.height <= a.y;
            EXPECT_TRUE(are_apart) << i << ' ' << k;
        }
    }
}

TEST(LightmapLayout, TexelsHaveOneSizeInTheWorld) {
    Scene scene = boxes({moved({0, 0, 0}), moved({9, 0, 0}, 2.0),
                         glm::scale(glm::dmat4(1.0), glm::dvec3(3.0, 1.0, 0.5)), moved({0, 0, 0})});
    scene.instances[3].lightmap.scale = 2.0f;
    const LightmapLayout layout = layout_of(scene, {.texels_per_meter = 8.0});
    EXPECT_EQ(layout.packings.size(), 3u);  // twice as large, or twice as fine, is the same
    for (size_t i = 0; i < 4; ++i) {
        for (size_t triangle = 0; triangle < 12; ++triangle) {
            EXPECT_NEAR(texels_per_meter(layout.packings[layout.places[i].packing], scene.meshes[0],
                                         triangle, scene.instances[i].world_from_mesh),
                        i == 3 ? 16.0 : 8.0, 0.01)
                << i;
        }
    }
}

TEST(LightmapLayout, AnotherObjectMovesRectanglesByWholeTexels) {
    const std::vector<glm::dmat4> transforms{moved({0, 0, 0}), moved({9, 0, 0}, 1.7)};
    const Scene few = boxes(transforms);
    Scene many = few;
    test::add_box(many, kGrey, test::Facing::Outward, {20, 0, 0}, {31, 9, 7});
    const LightmapLayout a = layout_of(few), b = layout_of(many);
    for (size_t i = 0; i < few.instances.size(); ++i) {
        EXPECT_EQ(a.packings[a.places[i].packing].charts, b.packings[b.places[i].packing].charts);
    }
}

TEST(LightmapLayout, ObjectsThatMoveOrTakeProbesOrGlowHaveNoTexels) {
    Scene scene = boxes({moved({0, 0, 0}), moved({5, 0, 0}), moved({9, 0, 0}), moved({13, 0, 0})});
    scene.instances[0].contributes_gi = false;
    scene.instances[1].lightmap.receive_gi = ReceiveGi::Probes;
    scene.instances[2].lightmap.scale = 0.0f;
    const LightmapLayout layout = layout_of(scene);
    for (size_t i = 0; i < 3; ++i) EXPECT_FALSE(layout.places[i].has_lightmap()) << i;
    EXPECT_TRUE(layout.places[3].has_lightmap());
    scene.materials[0].is_unlit = true;
    EXPECT_EQ(layout_of(scene).page_count, 0u);
}

TEST(LightmapLayout, FullPagesAreFollowedByOthers) {
    std::vector<glm::dmat4> transforms;
    for (int i = 0; i < 40; ++i) transforms.push_back(moved({5.0 * i, 0, 0}));
    const LightmapLayout layout = layout_of(boxes(transforms), {.page_size = 256});
    // 40 boxes of 22 m² at 100 texels a square metre.
    EXPECT_GE(layout.page_count, 2u);
    EXPECT_LE(layout.page_count, 4u);
    EXPECT_EQ(layout.places.back().corner.page, layout.page_count - 1);
}

TEST(LightmapLayout, AnObjectLargerThanAPageIsAnErrorThatNamesIt) {
    Scene scene;
    test::add_floor(scene, kGrey, 5000.0f).name = "ground";
    const std::string error = error_of(scene, {});
    EXPECT_TRUE(error.starts_with("object \"ground\": ")) << error;
    EXPECT_NE(error.find("1024"), std::string::npos) << error;
    EXPECT_NE(error.find("extras.lightmap_scale"), std::string::npos) << error;
    scene.instances[0].lightmap.scale = 0.01f;
    EXPECT_EQ(layout_of(scene).page_count, 1u);
}

TEST(LightmapLayout, TheErrorNamesALightmapScaleThatFits) {
    Scene scene = boxes({moved({0, 0, 0})});
    scene.instances[0].lightmap.scale = 3.0f;
    const LightmapLayoutSettings settings{.texels_per_meter = 20.0, .page_size = 64};
    const std::string error = error_of(scene, settings);
    const std::string before = "lower its extras.lightmap_scale from 3 to ";
    const size_t found = error.find(before);
    ASSERT_NE(found, std::string::npos) << error;
    const float scale = std::stof(error.substr(found + before.size()));
    scene.instances[0].lightmap.scale = scale;
    EXPECT_EQ(error_of(scene, settings), "");
    // Bisection to 1 / 64, and two digits.
    scene.instances[0].lightmap.scale = 1.2f * scale;
    EXPECT_NE(error_of(scene, settings), "");
}

TEST(LightmapLayout, TheErrorNamesScalesByTwoDigits) {
    Scene scene = boxes({moved({0, 0, 0})});
    scene.instances[0].lightmap.scale = 3.0f;
    for (uint32_t page_size = 20; page_size <= 100; page_size += 2) {
        const std::string error =
            error_of(scene, {.texels_per_meter = 20.0, .page_size = page_size});
        const std::string before = "lower its extras.lightmap_scale from 3 to ";
        const size_t found = error.find(before);
        ASSERT_NE(found, std::string::npos) << error;
        const size_t begin = found + before.size();
        std::string digits = error.substr(begin, error.find(' ', begin) - begin);
        std::erase(digits, '.');
        digits.erase(0, digits.find_first_not_of('0'));
        EXPECT_LE(digits.size(), 2u) << error;
    }
}

TEST(LightmapLayout, RejectsSettingsThatAreOutOfRange) {
    const Scene scene = boxes({moved({0, 0, 0})});
    EXPECT_NE(error_of(scene, {.texels_per_meter = 0.0}), "");
    EXPECT_NE(error_of(scene, {.texels_per_meter = NAN}), "");
    EXPECT_NE(error_of(scene, {.page_size = 8}), "");
    EXPECT_NE(error_of(scene, {.page_size = 1u << 20}), "");
}

TEST(LightmapLayout, AuthoredUvsAreKeptOrRepaired) {
    Scene scene;
    test::add_floor(scene, kGrey, 2.0f).name = "good";
    scene.meshes[0].uvs[1] = scene.meshes[0].uvs[0];
    test::add_floor(scene, kGrey, 2.0f).name = "outside";
    for (const glm::vec2& uv : scene.meshes[1].uvs[0]) scene.meshes[1].uvs[1].push_back(uv + 1e6f);
    const LightmapLayout kept = layout_of(scene, {.uvs = LightmapUvs::Keep});
    ASSERT_EQ(kept.warnings.size(), 1u);
    EXPECT_TRUE(kept.warnings[0].starts_with("object \"outside\": TEXCOORD_1 leaves 0 to 1 at 6 "))
        << kept.warnings[0];
    EXPECT_NEAR(texels_per_meter(kept.packings[0], scene.meshes[0], 0, glm::dmat4(1.0)), 10.0,
                1e-3);
    const LightmapLayout repaired = layout_of(scene, {.uvs = LightmapUvs::Repair});
    EXPECT_TRUE(repaired.warnings[0].ends_with("unwrapped anew")) << repaired.warnings[0];
}

TEST(LightmapLayout, ThreadsChangeNothing) {
    std::vector<glm::dmat4> transforms;
    for (int i = 0; i < 9; ++i) transforms.push_back(moved({5.0 * i, 0, 0}, 1.0 + 0.1 * i));
    const LightmapLayout one = layout_of(boxes(transforms), {.thread_count = 1});
    const LightmapLayout three = layout_of(boxes(transforms), {.thread_count = 3});
    for (size_t i = 0; i < transforms.size(); ++i) {
        EXPECT_EQ(one.places[i].packing, three.places[i].packing);
        EXPECT_EQ(one.places[i].corner, three.places[i].corner);
    }
}

}  // namespace
}  // namespace tetralight
