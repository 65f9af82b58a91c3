// SPDX-License-Identifier: Apache-2.0
#include <ImfRgbaFile.h>
#include <gtest/gtest.h>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <numbers>
#include <regex>

#include <tetralight/engines/export_target.h>
#include <tetralight/engines/sampled_grid.h>
#include "tests/engines/linear_texture.h"
#include "tests/support/random_probes.h"
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

ExportedVolume exported_unreal(const ProbeVolume& volume, const ExportSettings& settings) {
    const auto exported = find_export_target("unreal")->make(volume.view(), settings);
    EXPECT_TRUE(exported);
    return *exported;
}

/// The code of the page.
std::string material_code(const std::string& page) {
    const size_t begin = page.find("```hlsl\n") + 8;
    return page.substr(begin, page.find("```", begin) - begin);
}

glm::vec3 constant(const std::string& code, const std::string& name) {
    std::smatch match;
    const std::regex pattern(name + R"( = float3\(([-0-9.e+]+), ([-0-9.e+]+), ([-0-9.e+]+)\))");
    EXPECT_TRUE(std::regex_search(code, match, pattern)) << name;
    return {std::stof(match[1]), std::stof(match[2]), std::stof(match[3])};
}

uint32_t number_after(const std::string& page, const std::string& words) {
    return static_cast<uint32_t>(std::stoul(page.substr(page.find(words) + words.size())));
}

/// What the page makes of its files in Unreal: the volume texture of the tiles of the sheet, as
/// the editor cuts them, sampled as the code of the page does.
class UnrealVolume {
  public:
    explicit UnrealVolume(const ExportedVolume& exported) {
        const std::string& page = exported.files[0].content;
        const std::string code = material_code(page);
        min_ = constant(code, "BoxMin");
        box_ = constant(code, "BoxSize");
        cells_ = constant(code, "Cells");
        scale_ = std::stof(code.substr(code.find("Scale = ") + 8));
        size_ = {number_after(page, "Tile Size X "), number_after(page, "Tile Size Y "), 0};
        read_sheet(exported.files[1].content);
    }

    /// Light at a position in centimetres, Z up.
    [[nodiscard]] glm::vec3 light(const glm::vec3& position, const glm::vec3& normal) const {
        const glm::vec3 p = glm::vec3(position.x, position.z, position.y) * 0.01f;
        const glm::vec3 n(normal.x, normal.z, normal.y);
        const glm::vec3 place =
            glm::clamp((p - min_) / box_ * cells_, glm::vec3(0.5f), cells_ - 0.5f);
        const glm::vec3 uvw = place / (cells_ * glm::vec3(1, 1, 7));
        std::array<glm::vec4, 7> sh{};
        for (int i = 0; i < 7; ++i) {
            sh[static_cast<size_t>(i)] =
                filtered(uvw + glm::vec3(0, 0, static_cast<float>(i) / 7.0f));
        }
        const glm::vec4 n1(n, 1.0f);
        const glm::vec4 n2(n.x * n.y, n.y * n.z, n.z * n.z, n.z * n.x);
        glm::vec3 sum = glm::vec3(sh[6]) * (n.x * n.x - n.y * n.y);
        for (int c = 0; c < 3; ++c) {
            sum[c] += glm::dot(sh[static_cast<size_t>(c)], n1) +
                      glm::dot(sh[static_cast<size_t>(c) + 3], n2);
        }
        return glm::max(sum * scale_, 0.0f);
    }

    [[nodiscard]] glm::uvec3 size() const { return size_; }

  private:
    void read_sheet(const std::string& bytes) {
        const TempFolder folder;
        Imf::RgbaInputFile file(folder.write("sheet.exr", bytes).c_str());
        const auto width = static_cast<uint32_t>(file.dataWindow().max.x + 1);
        const auto height = static_cast<uint32_t>(file.dataWindow().max.y + 1);
        std::vector<Imf::Rgba> pixels(size_t{width} * height);
        file.setFrameBuffer(pixels.data(), 1, width);
        file.readPixels(0, static_cast<int>(height) - 1);
        const uint32_t columns = width / size_.x;
        size_.z = columns * (height / size_.y);
        for (uint32_t i = 0; i < size_.x * size_.y * size_.z; ++i) {
            const uint32_t z = i / (size_.x * size_.y);
            const uint32_t x = z % columns * size_.x + i % size_.x;
            const uint32_t y = z / columns * size_.y + i / size_.x % size_.y;
            const Imf::Rgba& pixel = pixels[size_t{y} * width + x];
            texels_.emplace_back(pixel.r, pixel.g, pixel.b, pixel.a);
        }
    }

    [[nodiscard]] glm::vec4 filtered(const glm::vec3& uvw) const {
        return test::filtered_texel(size_, uvw, [&](size_t index) { return texels_[index]; });
    }

    glm::vec3 min_{0.0f};
    glm::vec3 box_{1.0f};
    glm::vec3 cells_{1.0f};
    float scale_ = 0.0f;
    glm::uvec3 size_{0};
    std::vector<glm::vec4> texels_;
};

/// From metres with Y up, as Unreal's importer of glTF converts.
glm::vec3 unreal_position(const glm::dvec3& position) {
    return glm::vec3(position.x, position.z, position.y) * 100.0f;
}

TEST(ExportUnreal, ShowsTheLightOfTheCenters) {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(60, 5, 3.0));
    std::mt19937_64 random(1);
    const IrradianceSh ambient = irradiance_from_radiance(constant_radiance(glm::vec3(60.0f)));
    for (IrradianceSh& light : volume.irradiance) light += ambient;  // nowhere negative
    const ExportSettings settings{.name = "court", .resolution = {3, 4, 2}};
    const ExportedVolume exported = exported_unreal(volume, settings);
    const UnrealVolume unreal(exported);
    EXPECT_EQ(unreal.size(), glm::uvec3(3, 4, 14));
    const SampledGrid grid = *sample_grid(volume.view(), settings);
    for (uint32_t i = 0; i < 24; ++i) {
        const glm::dvec3 center = grid.center(i % 3, i / 3 % 4, i / 12);
        const IrradianceSh light = light_at(volume.view(), center, Walls::HideProbes);
        const glm::vec3 normal = test::random_direction(random);
        const glm::vec3 shown =
            unreal.light(unreal_position(center), glm::vec3(normal.x, normal.z, normal.y));
        const glm::vec3 expected = evaluate_irradiance(light, normal) / std::numbers::pi_v<float>;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown[c] / expected[c], 1.0f, 2e-3f);
    }
    EXPECT_EQ(exported.difference, measure_difference(volume.view(), grid));
}

/// Between centers, and beyond the outermost ones, where slabs of other coefficients are near.
TEST(ExportUnreal, BlendsAsTheGridDoes) {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(60, 6, 3.0));
    const IrradianceSh ambient = irradiance_from_radiance(constant_radiance(glm::vec3(60.0f)));
    for (IrradianceSh& light : volume.irradiance) light += ambient;
    const ExportSettings settings{.resolution = {4, 3, 5}};
    const UnrealVolume unreal(exported_unreal(volume, settings));
    const SampledGrid grid = *sample_grid(volume.view(), settings);
    for (const glm::dvec3& position : test::random_positions(200, 7, 3.3)) {
        const float expected = evaluate_irradiance(grid.sample(position), {0, 0, 1}).g;
        const float shown = unreal.light(unreal_position(position), {0, 1, 0}).g;
        EXPECT_NEAR(shown * std::numbers::pi_v<float> / expected, 1.0f, 3e-3f);
    }
}

TEST(ExportUnreal, SheetsHoldAsManyTilesAsTheVolumeHasSlices) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(20, 8));
    for (const uint32_t z : {1u, 2u, 11u, 73u}) {
        const UnrealVolume unreal(exported_unreal(volume, {.resolution = {2, 3, z}}));
        EXPECT_EQ(unreal.size(), glm::uvec3(2, 3, 7 * z));
    }
    const auto refused =
        find_export_target("unreal")->make(volume.view(), {.resolution = {1, 1, 74}});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().field, "resolution");
}

/// The code in a function, with what Unreal's shaders define.
TEST(ExportUnreal, CodeIsHlsl) {
    if (std::string_view(TETRALIGHT_GLSLANG).ends_with("NOTFOUND")) {
        GTEST_SKIP() << "glslangValidator is not here: install glslang-tools to run this test";
    }
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(20, 9));
    const ExportedVolume exported = exported_unreal(volume, {.resolution = {2, 2, 2}});
    const std::string shader =
        "#define Texture3DSampleLevel(t, s, uvw, level) t.SampleLevel(s, uvw, level)\n"
        "Texture3D Volume : register(t0);\nSamplerState VolumeSampler : register(s1);\n"
        "float3 CustomExpression(Texture3D Probes, SamplerState ProbesSampler, float3 Position, "
        "float3 Normal)\n{\n" +
        material_code(exported.files[0].content) +
        "}\nfloat4 main(float3 p : TEXCOORD0, float3 n : TEXCOORD1) : SV_Target\n"
        "{\n    return float4(CustomExpression(Volume, VolumeSampler, p, n), 1);\n}\n";
    const TempFolder folder;
    const std::string command = TETRALIGHT_GLSLANG " -D -V -e main -S frag -o " +
                                folder.path("out.spv") + " " + folder.write("a.frag", shader);
    EXPECT_EQ(std::system(command.c_str()), 0) << shader;
}

}  // namespace
}  // namespace tetralight
