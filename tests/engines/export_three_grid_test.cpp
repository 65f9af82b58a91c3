// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>

#include <tetralight/engines/export_target.h>
#include <tetralight/engines/sampled_grid.h>
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

/// Reads the texture as the shader of three.js does: texel t of a cell is in the volume of nz + 2
/// slices that begins at t (nz + 2), one slice after its start.
RadianceSh texel_light(const std::string& bytes, const nlohmann::json& header, uint32_t x,
                       uint32_t y, uint32_t z) {
    const auto nx = header["resolution"][0].get<size_t>();
    const auto ny = header["resolution"][1].get<size_t>();
    const auto nz = header["resolution"][2].get<size_t>();
    std::array<float, 28> floats{};
    for (size_t t = 0; t < 7; ++t) {
        const size_t slice = t * (nz + 2) + 1 + z;
        std::memcpy(floats.data() + 4 * t, bytes.data() + 16 * ((slice * ny + y) * nx + x), 16);
    }
    RadianceSh light;
    for (size_t i = 0; i < 9; ++i) {
        light.coefficients[i] = {floats[3 * i], floats[3 * i + 1], floats[3 * i + 2]};
    }
    return light;
}

TEST(ExportThreeGrid, HoldsTheLightOfTheCenters) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(50, 7));
    const ExportTarget* target = find_export_target("three-grid");
    ASSERT_NE(target, nullptr);
    const ExportSettings settings{.name = "a \"b\"", .resolution = {3, 4, 2}};
    const auto exported = target->make(volume.view(), settings);
    ASSERT_TRUE(exported);
    ASSERT_EQ(exported->files.size(), 2u);
    const auto header = nlohmann::json::parse(exported->files[0].content);
    const std::string& bytes = exported->files[1].content;
    EXPECT_EQ(header["data"], exported->files[1].name);
    EXPECT_EQ(header["texture"], (nlohmann::json{3, 4, 28}));
    ASSERT_EQ(bytes.size(), 3u * 4 * 28 * 16);
    const auto grid = sample_grid(volume.view(), settings);
    ASSERT_TRUE(grid);
    for (uint32_t z = 0; z < 2; ++z) {
        for (uint32_t y = 0; y < 4; ++y) {
            for (uint32_t x = 0; x < 3; ++x) {
                EXPECT_EQ(texel_light(bytes, header, x, y, z),
                          radiance_from_irradiance(grid->at(x, y, z)));
            }
        }
    }
    EXPECT_EQ(exported->difference, measure_difference(volume.view(), *grid));
}

}  // namespace
}  // namespace tetralight
