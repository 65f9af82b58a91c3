// SPDX-License-Identifier: Apache-2.0
// Each row of the table in docs/embed.md: the numbers that an engine gets, evaluated by the formula
// of its own shaders at a normal in its own axes, are the light that we have there.
#include <tetralight/runtime/engine_sh.h>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numbers>
#include <random>

namespace tetralight {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

using Coefficients = std::array<glm::vec3, kShCoefficientCount>;
using Factors = std::array<float, kShCoefficientCount>;

glm::vec3 sum(const Coefficients& c, const Factors& f) {
    glm::vec3 total(0.0f);
    for (size_t i = 0; i < c.size(); ++i) total += c[i] * f[i];
    return total;
}

/// ShadeSH9: SHAr = (c3, c1, c2, c0 − c6), SHBr = (c4, c5, 3 c6, c7), SHC = c8.
glm::vec3 shade_in_unity(const Coefficients& c, glm::vec3 n) {
    const glm::vec3 linear = c[3] * n.x + c[1] * n.y + c[2] * n.z + (c[0] - c[6]);
    const glm::vec3 quadratic =
        c[4] * (n.x * n.y) + c[5] * (n.y * n.z) + 3.0f * c[6] * (n.z * n.z) + c[7] * (n.z * n.x);
    return linear + quadratic + c[8] * (n.x * n.x - n.y * n.y);
}

/// SHBasisFunction3 with its signs, times CalcDiffuseTransferSH3's π, 2π/3, π/4; over π.
glm::vec3 shade_in_unreal(const Coefficients& c, glm::vec3 n) {
    const float l1 = 2.0f / 3.0f, l2 = 0.25f;
    return sum(c, {0.282095f, -0.488603f * n.y * l1, 0.488603f * n.z * l1, -0.488603f * n.x * l1,
                   1.092548f * n.x * n.y * l2, -1.092548f * n.y * n.z * l2,
                   0.315392f * (3 * n.z * n.z - 1) * l2, -1.092548f * n.x * n.z * l2,
                   0.546274f * (n.x * n.x - n.y * n.y) * l2});
}

/// scene_forward_clustered.glsl: the clamped cosine's π, 2π/3, π/4, and no 1/π.
glm::vec3 shade_in_godot(const Coefficients& c, glm::vec3 n) {
    const float l0 = kPi, l1 = 2.0f * kPi / 3.0f, l2 = kPi / 4.0f;
    return sum(c, {0.282095f * l0, 0.488603f * n.y * l1, 0.488603f * n.z * l1, 0.488603f * n.x * l1,
                   1.092548f * n.x * n.y * l2, 1.092548f * n.y * n.z * l2,
                   0.315392f * (3 * n.z * n.z - 1) * l2, 1.092548f * n.x * n.z * l2,
                   0.546274f * (n.x * n.x - n.y * n.y) * l2});
}

/// shGetIrradianceAt of three.js, whose Lambert term divides by π.
glm::vec3 shade_in_three(const Coefficients& c, glm::vec3 n) {
    const glm::vec3 irradiance =
        c[0] * 0.886227f + c[1] * (2.0f * 0.511664f * n.y) + c[2] * (2.0f * 0.511664f * n.z) +
        c[3] * (2.0f * 0.511664f * n.x) + c[4] * (2.0f * 0.429043f * n.x * n.y) +
        c[5] * (2.0f * 0.429043f * n.y * n.z) + c[6] * (0.743125f * n.z * n.z - 0.247708f) +
        c[7] * (2.0f * 0.429043f * n.x * n.z) + c[8] * (0.429043f * (n.x * n.x - n.y * n.y));
    return irradiance / kPi;
}

/// diffuseIrradiance of Filament: the polynomials as they are.
glm::vec3 shade_in_filament(const Coefficients& c, glm::vec3 n) {
    return sum(c, {1, n.y, n.z, n.x, n.y * n.x, n.y * n.z, 3 * n.z * n.z - 1, n.z * n.x,
                   n.x * n.x - n.y * n.y});
}

struct EngineRow {
    const char* name;
    Engine engine;
    /// Irradiance / π as the engine's shader has it.
    glm::vec3 (*shade)(const Coefficients& c, glm::vec3 normal);
    /// Where a metre along our x, y and z leads.
    std::array<glm::vec3, 3> axes;
};

constexpr glm::vec3 kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

const EngineRow kRows[] = {
    {"Unity", Engine::Unity, shade_in_unity, {-kX, kY, kZ}},
    {"Unreal", Engine::Unreal, shade_in_unreal, {100.0f * kX, 100.0f * kZ, 100.0f * kY}},
    {"Godot", Engine::Godot, shade_in_godot, {kX, kY, kZ}},
    {"ThreeJs", Engine::ThreeJs, shade_in_three, {kX, kY, kZ}},
    {"Filament", Engine::Filament, shade_in_filament, {kX, kY, kZ}},
};

class EngineSh : public testing::TestWithParam<EngineRow> {
  protected:
    std::mt19937_64 engine_{1};

    glm::vec3 random_vector(float low, float high) {
        std::uniform_real_distribution<float> value(low, high);
        const float x = value(engine_), y = value(engine_), z = value(engine_);
        return {x, y, z};
    }
};

TEST_P(EngineSh, ShadesAsWeDo) {
    for (int i = 0; i < 1000; ++i) {
        IrradianceSh sh;
        for (glm::vec3& c : sh.coefficients) c = random_vector(-1.0f, 2.0f);
        const glm::vec3 normal = glm::normalize(random_vector(-1.0f, 1.0f) + 0.001f);
        const glm::vec3 expected = evaluate_irradiance(sh, normal) / kPi;
        const glm::vec3 shaded = GetParam().shade(engine_sh(GetParam().engine, sh),
                                                  engine_direction(GetParam().engine, normal));
        ASSERT_LE(glm::distance(shaded, expected), 2e-5f);
    }
}

TEST_P(EngineSh, ConstantLightIsItsAlbedo) {
    const IrradianceSh sh = irradiance_from_radiance(constant_radiance(glm::vec3(0.5f)));
    EXPECT_NEAR(GetParam().shade(engine_sh(GetParam().engine, sh), kY).x, 0.5f, 1e-5f);
}

TEST_P(EngineSh, PositionsAreInTheEnginesAxesAndUnit) {
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 metre(0.0f);
        metre[axis] = 1.0f;
        EXPECT_EQ(engine_position(GetParam().engine, metre),
                  GetParam().axes[static_cast<size_t>(axis)]);
    }
    const glm::vec3 position(1.0f, 2.0f, 3.0f);
    EXPECT_EQ(position_from_engine(GetParam().engine, engine_position(GetParam().engine, position)),
              position);
    EXPECT_EQ(
        direction_from_engine(GetParam().engine, engine_direction(GetParam().engine, position)),
        position);
}

INSTANTIATE_TEST_SUITE_P(Rows, EngineSh, testing::ValuesIn(kRows),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(EngineSh, UnityNegatesWhatIsOddInX) {
    IrradianceSh sh;
    sh.coefficients.fill(glm::vec3(1.0f));
    const Coefficients ours = engine_sh(Engine::Filament, sh),
                       theirs = engine_sh(Engine::Unity, sh);
    for (size_t i = 0; i < ours.size(); ++i) {
        const float sign = i == 3 || i == 4 || i == 7 ? -1.0f : 1.0f;
        EXPECT_NEAR(theirs[i].x, sign * ours[i].x, 1e-6f) << i;
    }
}

}  // namespace
}  // namespace tetralight
