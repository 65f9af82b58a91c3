// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/reflection/cube_image.h>

#include <gtest/gtest.h>

#include <cmath>

namespace tetralight {
namespace {

TEST(CubeImage, IndicesAndTexelsAreInverse) {
    const CubeImage cube{4, std::vector<glm::vec3>(cube_texel_count(4))};
    for (size_t i = 0; i < cube.texels.size(); ++i) EXPECT_EQ(cube.index(cube.texel(i)), i);
    EXPECT_EQ(cube.texel(1), (CubeTexel{0, 1, 0}));
    EXPECT_EQ(cube.texel(4), (CubeTexel{0, 0, 1}));
    EXPECT_EQ(cube.texel(16), (CubeTexel{1, 0, 0}));
}

TEST(ProjectCube, ABasisFunctionHasOneCoefficient) {
    constexpr uint32_t kSize = 64;
    for (int basis = 0; basis < kShCoefficientCount; ++basis) {
        CubeImage cube{kSize, {}};
        for (size_t i = 0; i < cube_texel_count(kSize); ++i)
            cube.texels.emplace_back(sh_basis(cube_direction(cube.texel(i), kSize))[basis]);
        const RadianceSh light = project_cube(cube);
        // The midpoint rule: the error falls with the square of the texel's angle, (π/2 / 64)².
        for (int i = 0; i < kShCoefficientCount; ++i)
            EXPECT_NEAR(light.coefficients[i].x, i == basis ? 1.0f : 0.0f, 6e-4f);
    }
}

}  // namespace
}  // namespace tetralight
