// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <glm/common.hpp>
#include <numbers>
#include <regex>

#include <tetralight/base/half.h>
#include <tetralight/base/ktx2.h>
#include <tetralight/engines/export_target.h>
#include <tetralight/engines/sampled_grid.h>
#include "tests/engines/linear_texture.h"
#include "tests/support/random_probes.h"
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

ExportedVolume exported_bevy(const ProbeVolume& volume, const ExportSettings& settings) {
    const auto exported = find_export_target("bevy")->make(volume.view(), settings);
    EXPECT_TRUE(exported);
    return *exported;
}

/// The three numbers after a member's name.
glm::dvec3 member(const std::string& world, const std::string& name) {
    std::smatch match;
    const std::regex pattern(name + R"(: \(([-0-9.e+]+), ([-0-9.e+]+), ([-0-9.e+]+)\))");
    EXPECT_TRUE(std::regex_search(world, match, pattern)) << name;
    return {std::stod(match[1]), std::stod(match[2]), std::stod(match[3])};
}

/// An irradiance volume as Bevy's shader reads it: `irradiance_volume_light` of bevy_pbr, whose
/// numbers it repeats.
class BevyVolume {
  public:
    explicit BevyVolume(const ExportedVolume& exported) : bytes_(exported.files[1].content) {
        const std::string& world = exported.files[0].content;
        translation_ = member(world, "translation");
        scale_ = member(world, "scale");
        intensity_ = std::stof(world.substr(world.find("intensity: ") + 11));
        Ktx2Header header;
        std::memcpy(&header, bytes_.data(), sizeof header);
        EXPECT_EQ(header.vk_format, kVkFormatRgba16Float);
        size_ = {header.width, header.height, header.depth};
        Ktx2Level level;
        std::memcpy(&level, bytes_.data() + sizeof header, sizeof level);
        EXPECT_EQ(level.size, uint64_t{8} * size_.x * size_.y * size_.z);
        EXPECT_EQ(level.offset + level.size, bytes_.size());
        texels_ = level.offset;
    }

    [[nodiscard]] glm::vec3 light(const glm::dvec3& position, const glm::vec3& normal) const {
        const glm::vec3 resolution(size_ / glm::uvec3(1, 2, 3));
        const glm::vec3 unit((position - translation_) / scale_);
        const glm::vec3 place =
            glm::clamp((unit + 0.5f) * resolution, glm::vec3(0.5f), resolution - glm::vec3(0.5f));
        const glm::vec3 uvw = place / glm::vec3(size_);
        glm::vec3 sum(0.0f);
        for (int axis = 0; axis < 3; ++axis) {
            const float half = normal[axis] < 0.0f ? 0.5f : 0.0f;
            const glm::vec3 offset(0.0f, half, static_cast<float>(axis) / 3.0f);
            sum += filtered(uvw + offset) * normal[axis] * normal[axis];
        }
        return sum * intensity_;
    }

    [[nodiscard]] glm::uvec3 size() const { return size_; }

  private:
    [[nodiscard]] glm::vec3 texel(size_t index) const {
        std::array<uint16_t, 4> halves{};
        std::memcpy(halves.data(), bytes_.data() + texels_ + 8 * index, 8);
        return {float_from_half(halves[0]), float_from_half(halves[1]), float_from_half(halves[2])};
    }

    [[nodiscard]] glm::vec3 filtered(const glm::vec3& uvw) const {
        return test::filtered_texel(size_, uvw, [&](size_t index) { return texel(index); });
    }

    const std::string& bytes_;
    glm::dvec3 translation_{0.0};
    glm::dvec3 scale_{1.0};
    float intensity_ = 0.0f;
    glm::uvec3 size_{0};
    size_t texels_ = 0;
};

void expect_near(const glm::vec3& shown, const glm::vec3& expected, float tolerance) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown[c], expected[c], tolerance);
}

/// Half floats have 11 digits; light of the volume is up to about 40.
constexpr float kTolerance = 0.03f;

TEST(ExportBevy, ShowsTheLightOfTheAxesAtTheCenters) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(60, 5, 3.0));
    const ExportSettings settings{.name = "court", .resolution = {3, 4, 2}};
    const ExportedVolume exported = exported_bevy(volume, settings);
    const BevyVolume bevy(exported);
    EXPECT_EQ(bevy.size(), glm::uvec3(3, 8, 6));
    const SampledGrid grid = *sample_grid(volume.view(), settings);
    for (uint32_t i = 0; i < 24; ++i) {
        const glm::dvec3 center = grid.center(i % 3, i / 3 % 4, i / 12);
        const IrradianceSh light = light_at(volume.view(), center, Walls::HideProbes);
        for (int side = 0; side < 6; ++side) {
            glm::vec3 normal(0.0f);
            normal[side / 2] = side % 2 == 0 ? 1.0f : -1.0f;
            expect_near(bevy.light(center, normal),
                        evaluate_irradiance(light, normal) / std::numbers::pi_v<float>, kTolerance);
        }
    }
}

/// Between centers too, and for other normals the cube of the six directions.
TEST(ExportBevy, BlendsAsItsDifferenceAssumes) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(60, 6, 3.0));
    const ExportSettings settings{.resolution = {4, 3, 5}};
    const ExportedVolume exported = exported_bevy(volume, settings);
    const BevyVolume bevy(exported);
    const LightDifference difference = measure_difference(
        volume.view(), random_places(volume.view(), kDifferencePlaces, world_bounds(volume.view())),
        [&](const glm::dvec3& position) -> IrradianceByNormal {
            return [&bevy, position](const glm::vec3& normal) {
                return bevy.light(position, normal) * std::numbers::pi_v<float>;
            };
        });
    ASSERT_TRUE(exported.difference);
    EXPECT_NEAR(exported.difference->from_light.median, difference.from_light.median, 1e-3);
    EXPECT_NEAR(exported.difference->from_light.worst, difference.from_light.worst, 1e-3);
}

/// Light far from 1 is scaled into the range of half floats, and `intensity` scales it back.
TEST(ExportBevy, HoldsBrightAndFaintLight) {
    for (const float brightness : {1e-6f, 1.0f, 1e6f}) {
        ProbeVolume volume = test::make_lit_volume(test::random_positions(20, 7));
        const auto light = irradiance_from_radiance(constant_radiance(glm::vec3(brightness)));
        volume.irradiance.assign(volume.irradiance.size(), light);
        const ExportedVolume exported = exported_bevy(volume, {.resolution = {2, 2, 2}});
        const BevyVolume bevy(exported);
        EXPECT_NEAR(bevy.light({0, 0, 0}, {0, 1, 0}).g / brightness, 1.0f, 1e-3f);
        EXPECT_LT(exported.difference->from_light.worst, 1e-5);
    }
}

TEST(ExportBevy, WorldNamesTheTextureAndItsPlace) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(20, 8));
    const Box<glm::dvec3> box{{-2, 0, 1}, {2, 3, 9}};
    const ExportedVolume exported =
        exported_bevy(volume, {.name = "a \"b\" #1", .bounds = box, .resolution = {1, 1, 1}});
    const std::string& world = exported.files[0].content;
    EXPECT_EQ(exported.files[0].name, "a \"b\" #1.scn.ron");
    EXPECT_EQ(exported.files[1].name, "a \"b\" _1.ktx2");
    EXPECT_NE(world.find(R"(voxels: Path("a \"b\" _1.ktx2"))"), std::string::npos);
    EXPECT_EQ(member(world, "translation"), glm::dvec3(0, 1.5, 5));
    EXPECT_EQ(member(world, "scale"), glm::dvec3(4, 3, 8));
}

TEST(ExportBevy, RefusesTexturesThatAreTooLarge) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(20, 9));
    const auto refused =
        find_export_target("bevy")->make(volume.view(), {.resolution = {1, 1, 683}});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().field, "resolution");
    EXPECT_TRUE(find_export_target("bevy")->make(volume.view(), {.resolution = {1, 1, 682}}));
}

/// ktx-parse, the reader of JavaScript engines, where `./run test` could install it.
TEST(ExportBevy, TextureReadsBackByKtxParse) {
    if (!std::filesystem::exists(TETRALIGHT_NODE_MODULES "/ktx-parse/package.json")) {
        GTEST_SKIP() << "npm has not installed ktx-parse";
    }
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(20, 10));
    const ExportedVolume exported = exported_bevy(volume, {.resolution = {3, 4, 2}});
    const TempFolder folder;
    const std::string& file = exported.files[1].content;
    const std::string path = folder.write("a.ktx2", file);
    const std::string texels = folder.write("texels", file.substr(file.size() - 3 * 8 * 6 * 8));
    const std::string command = "node " TETRALIGHT_SOURCE_DIR
                                "/tests/engines/read_bevy.mjs " TETRALIGHT_NODE_MODULES " " +
                                path + " " + texels + " 3 8 6";
    EXPECT_EQ(std::system(command.c_str()), 0);
}

}  // namespace
}  // namespace tetralight
