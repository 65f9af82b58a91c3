// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/error_text.h>
#include <tetralight/runtime/pack_instances.h>

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <glm/mat4x4.hpp>
#include <limits>
#include <random>
#include <vector>

namespace tetralight {
namespace {

/// One tetrahedron over the axes with its four hull cells, and light that differs from probe to
/// probe.
ProbeVolume make_volume() {
    ProbeVolume volume;
    volume.info.dimension = Dimension::Space;
    volume.info.inner_cell_count = 1;
    volume.info.extent = 1.0f;
    volume.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    volume.cells = {{{0, 1, 2, 3}, {1, 2, 3, 4}}};
    for (uint32_t face = 0; face < 4; ++face) {
        Cell hull;
        HullCellRays rays;
        for (size_t i = 0; i < 3; ++i) {
            const auto vertex = static_cast<uint32_t>(kOutwardFaces[face][i]);
            hull.vertices[i] = vertex;
            hull.neighbors[i] = 1 + vertex;
            rays.rays[i] = glm::normalize(volume.positions[vertex] - glm::vec3(0.25f));
        }
        hull.neighbors[3] = 0;
        volume.cells.push_back(hull);
        volume.hull_rays.push_back(rays);
    }
    for (int probe = 0; probe < 4; ++probe) {
        IrradianceSh sh;
        for (int i = 0; i < kShCoefficientCount; ++i) {
            sh.coefficients[i] = glm::vec3(1 + i, 2 * probe - i, 3 - probe * i);
        }
        volume.irradiance.push_back(sh);
        volume.occlusion.emplace_back(0.25f * static_cast<float>(probe));
    }
    volume.info.ambient.coefficients[0] = glm::vec3(7.0f);
    return volume;
}

std::vector<glm::vec3> make_positions(size_t count) {
    std::mt19937 engine(1);
    std::uniform_real_distribution<float> coordinate(-1.0f, 2.0f);
    std::vector<glm::vec3> positions(count);
    for (glm::vec3& p : positions) p = {coordinate(engine), coordinate(engine), coordinate(engine)};
    return positions;
}

/// The arrays that a renderer keeps.
struct ShaderArrays {
    std::array<std::vector<glm::vec4>, 7> arrays;

    explicit ShaderArrays(size_t count) {
        for (auto& array : arrays) array.resize(count);
    }

    PackedShArrays spans() {
        return {arrays[0], arrays[1], arrays[2], arrays[3], arrays[4], arrays[5], arrays[6]};
    }

    [[nodiscard]] PackedSh packed(size_t i) const {
        return {arrays[0][i], arrays[1][i], arrays[2][i], arrays[3][i],
                arrays[4][i], arrays[5][i], arrays[6][i]};
    }
};

void expect_single_query(const ProbeVolumeView& volume, glm::vec3 position, const PackedSh& light,
                         const OutsideHull& outside = {}) {
    const CellLocation location = locate(volume, position, kNoIndex, outside);
    const PackedSh expected = pack_sh(interpolate(volume, location).irradiance);
    const auto* a = reinterpret_cast<const float*>(&light);
    const auto* b = reinterpret_cast<const float*>(&expected);
    for (int k = 0; k < 28; ++k) EXPECT_NEAR(a[k], b[k], 1e-5f) << "float " << k;
}

class PackInstances : public testing::TestWithParam<size_t> {};

TEST_P(PackInstances, FillsSevenArraysAsSingleQueriesAnswer) {
    const ProbeVolume volume = make_volume();
    const auto positions = make_positions(GetParam());
    ShaderArrays light(positions.size());
    std::vector<glm::vec4> occlusion(positions.size());
    ASSERT_TRUE(pack_instances(
        volume.view(), {.positions = positions, .arrays = light.spans(), .occlusion = occlusion}));
    for (size_t i = 0; i < positions.size(); ++i) {
        expect_single_query(volume.view(), positions[i], light.packed(i));
        const CellLocation location = locate(volume.view(), positions[i]);
        EXPECT_NEAR(occlusion[i].x, interpolate(volume.view(), location).occlusion.x, 1e-6f);
    }
}

TEST_P(PackInstances, FillsOnePackedShAnInstance) {
    const ProbeVolume volume = make_volume();
    const auto positions = make_positions(GetParam());
    std::vector<PackedSh> light(positions.size());
    ASSERT_TRUE(pack_instances(volume.view(), {.positions = positions, .packed = light}));
    for (size_t i = 0; i < positions.size(); ++i) {
        expect_single_query(volume.view(), positions[i], light[i]);
    }
}

// Around the border of a block.
INSTANTIATE_TEST_SUITE_P(Counts, PackInstances, testing::Values(0, 1, 127, 128, 129, 1023));

TEST(PackInstances, WritesIntoAnInstanceBufferAndNothingBeside) {
    struct Instance {
        glm::mat4 world{1.0f};
        PackedSh light;
        glm::vec4 occlusion;
    };

    const ProbeVolume volume = make_volume();
    const auto positions = make_positions(200);
    std::vector<Instance> instances(positions.size());
    const auto bytes = std::as_writable_bytes(std::span(instances));
    ASSERT_TRUE(pack_instances(
        volume.view(), {.positions = positions,
                        .packed = strided(bytes.subspan(offsetof(Instance, light)),
                                          ShFormat::Packed, sizeof(Instance)),
                        .occlusion = strided_occlusion(bytes.subspan(offsetof(Instance, occlusion)),
                                                       sizeof(Instance))}));
    for (size_t i = 0; i < positions.size(); ++i) {
        EXPECT_EQ(instances[i].world, glm::mat4(1.0f));
        expect_single_query(volume.view(), positions[i], instances[i].light);
    }
}

TEST(PackInstances, KeepsHintsAndTheChoiceOutsideTheHull) {
    const ProbeVolume volume = make_volume();
    const auto positions = make_positions(300);
    const OutsideHull outside{OutsidePolicy::Ambient, 0.5f};
    ShaderArrays light(positions.size());
    std::vector<uint32_t> hints(positions.size(), kNoIndex);
    ASSERT_TRUE(pack_instances(
        volume.view(),
        {.positions = positions, .hints = hints, .arrays = light.spans(), .outside = outside}));
    for (size_t i = 0; i < positions.size(); ++i) {
        expect_single_query(volume.view(), positions[i], light.packed(i), outside);
        EXPECT_LT(hints[i], volume.cells.size());
    }
}

TEST(PackInstances, WallsHideProbesUnlessIgnored) {
    ProbeVolume volume = make_volume();
    volume.visibility_blocks = {{0, 1}};
    volume.cell_visibility.resize(1);
    volume.cell_visibility[0].codes = {255, 255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255};
    const std::vector<glm::vec3> positions{{0.2f, 0.3f, 0.1f}};
    const CellLocation location = locate(volume.view(), positions[0]);
    std::vector<PackedSh> light(1);
    for (const Walls walls : {Walls::HideProbes, Walls::Ignore}) {
        ASSERT_TRUE(pack_instances(volume.view(),
                                   {.positions = positions, .packed = light, .walls = walls}));
        EXPECT_EQ(light[0], pack_sh(interpolate(volume.view(), location, {walls}).irradiance));
    }
    EXPECT_NE(interpolate(volume.view(), location),
              interpolate(volume.view(), location, {Walls::Ignore}));
}

TEST(PackInstances, HaveRenderingLayersAndRadiiAsBatchesDo) {
    ProbeVolume volume = make_volume();
    for (size_t i = 0; i < volume.positions.size(); ++i) {
        volume.rendering_layers.push_back(i % 2 == 0 ? 0b01 : 0b10);
    }
    const auto positions = make_positions(400);  // more than a block
    std::vector<uint32_t> layers(positions.size());
    for (size_t i = 0; i < layers.size(); ++i) layers[i] = static_cast<uint32_t>(i % 4);
    const std::vector<float> radii(positions.size(), 0.1f);
    std::vector<PackedSh> expected(positions.size());
    ASSERT_TRUE(interpolate(volume.view(), {.positions = positions,
                                            .irradiance = expected,
                                            .rendering_layers = layers,
                                            .radii = radii}));
    ShaderArrays light(positions.size());
    ASSERT_TRUE(pack_instances(volume.view(), {.positions = positions,
                                               .arrays = light.spans(),
                                               .rendering_layers = layers,
                                               .radii = radii}));
    for (size_t i = 0; i < positions.size(); ++i) EXPECT_EQ(light.packed(i), expected[i]);
    const auto report =
        pack_instances(volume.view(), {.positions = positions,
                                       .arrays = light.spans(),
                                       .rendering_layers = std::span(layers).first(399)});
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().field, "rendering_layers");
}

TEST(PackInstances, CountsPositionsThatAreNotFiniteInEveryBlock) {
    const ProbeVolume volume = make_volume();
    auto positions = make_positions(400);
    for (const size_t i : {5, 399}) positions[i].y = std::numeric_limits<float>::quiet_NaN();
    ShaderArrays light(positions.size());
    const auto report =
        pack_instances(volume.view(), {.positions = positions, .arrays = light.spans()});
    ASSERT_TRUE(report);
    EXPECT_EQ(report->not_finite_count, 2u);
    EXPECT_EQ(light.packed(399), pack_sh(volume.info.ambient));
}

TEST(PackInstances, NamesTheArrayThatIsTooShort) {
    const ProbeVolume volume = make_volume();
    const auto positions = make_positions(5);
    ShaderArrays light(5);
    light.arrays[5].resize(3);
    std::vector<glm::vec4> occlusion(4);
    EXPECT_EQ(
        error_text(pack_instances(volume.view(), {.positions = positions, .arrays = light.spans()})
                       .error()),
        "shb_b has room for 3 answers, but there are 5 positions");
    EXPECT_EQ(light.arrays[0][0], glm::vec4(0.0f)) << "written before all was checked";
    light.arrays[5].resize(5);
    EXPECT_EQ(error_text(pack_instances(volume.view(), {.positions = positions,
                                                        .arrays = light.spans(),
                                                        .occlusion = occlusion})
                             .error()),
              "occlusion has room for 4 answers, but there are 5 positions");
}

TEST(PackInstances, RefusesOutputsThatMakeNoSense) {
    const ProbeVolume volume = make_volume();
    const auto positions = make_positions(5);
    ShaderArrays light(5);
    std::vector<PackedSh> packed(5);
    std::vector<IrradianceSh> irradiance(5);
    EXPECT_FALSE(pack_instances(volume.view(), {.positions = positions}));
    EXPECT_FALSE(pack_instances(volume.view(), {.positions = positions, .packed = irradiance}));
    EXPECT_FALSE(pack_instances(
        volume.view(), {.positions = positions, .arrays = light.spans(), .packed = packed}));
}

TEST(PackInstances, RefusesAnswersOverEachOtherAndAtOddAddresses) {
    const ProbeVolume volume = make_volume();
    const auto positions = make_positions(3);
    std::vector<PackedSh> light(4);
    std::vector<glm::vec4> occlusion(4);
    const auto bytes = std::as_writable_bytes(std::span(light));
    const auto error_of = [&](const ShOutput& packed, const OcclusionOutput& lit) {
        const auto report = pack_instances(
            volume.view(), {.positions = positions, .packed = packed, .occlusion = lit});
        return report ? std::string() : error_text(report.error());
    };
    EXPECT_EQ(error_of(strided(bytes, ShFormat::Packed, 112), occlusion), "");
    EXPECT_EQ(error_of(strided(bytes, ShFormat::Packed, 108), occlusion),
              "irradiance has a stride of 108 bytes, and answers of 112");
    EXPECT_EQ(error_of(strided(bytes.subspan(1), ShFormat::Packed, 112), occlusion),
              "irradiance is not aligned to 4 bytes");
    EXPECT_EQ(error_of(strided(bytes, ShFormat::Packed, 114), occlusion),
              "irradiance is not aligned to 4 bytes");
    const auto floats = std::as_writable_bytes(std::span(occlusion));
    EXPECT_EQ(error_of(light, strided_occlusion(floats, 8)),
              "occlusion has a stride of 8 bytes, and answers of 16");
}

TEST(PackInstances, RefusesChoicesOutsideTheHullThatAreNone) {
    const ProbeVolume volume = make_volume();
    const auto positions = make_positions(3);
    ShaderArrays light(3);
    const auto error_of = [&](OutsideHull outside) {
        return error_text(
            pack_instances(volume.view(),
                           {.positions = positions, .arrays = light.spans(), .outside = outside})
                .error());
    };
    EXPECT_EQ(error_of({static_cast<OutsidePolicy>(9), 1.0f}), "outside has policy 9");
    EXPECT_EQ(error_of({OutsidePolicy::Ambient, -1.0f}),
              "fade_distance is -1; it must be positive and finite");
    EXPECT_EQ(light.arrays[0][0], glm::vec4(0.0f));
}

}  // namespace
}  // namespace tetralight
