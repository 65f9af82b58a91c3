// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/engine_sh.h>

#include <glm/mat3x3.hpp>
#include <numbers>

namespace tetralight {
namespace {

using Coefficients = std::array<glm::vec3, kShCoefficientCount>;

/// K_i: the factor of each polynomial of the basis.
constexpr std::array<float, kShCoefficientCount> kBasisConstants{
    0.2820948f, 0.4886025f, 0.4886025f, 0.4886025f, 1.0925484f,
    1.0925484f, 0.3153916f, 1.0925484f, 0.5462742f};

/// The Condon-Shortley sign of the functions of odd m.
constexpr std::array<float, kShCoefficientCount> kCondonShortley{1, -1, 1, -1, 1, -1, 1, -1, 1};

/// The columns are our axes in the axes of the engine.
glm::mat3 engine_from_ours(Engine engine) {
    switch (engine) {
        case Engine::Unity:
            return glm::mat3(-1, 0, 0, 0, 1, 0, 0, 0, 1);
        case Engine::Unreal:
            return glm::mat3(1, 0, 0, 0, 0, 1, 0, 1, 0);
        case Engine::Godot:
        case Engine::ThreeJs:
        case Engine::Filament:
            break;
    }
    return glm::mat3(1.0f);
}

float units_a_metre(Engine engine) {
    return engine == Engine::Unreal ? 100.0f : 1.0f;
}

/// Irradiance / π as factors of the polynomials 1, y, z, x, xy, yz, 3z² − 1, xz, x² − y².
Coefficients polynomial_factors(const IrradianceSh& irradiance) {
    Coefficients factors = irradiance.coefficients;
    for (size_t i = 0; i < factors.size(); ++i) {
        factors[i] *= kBasisConstants[i] * std::numbers::inv_pi_v<float>;
    }
    return factors;
}

Coefficients scaled(Coefficients coefficients, float factor) {
    for (glm::vec3& c : coefficients) c *= factor;
    return coefficients;
}

}  // namespace

std::array<glm::vec3, kShCoefficientCount> engine_sh(Engine engine,
                                                     const IrradianceSh& irradiance) noexcept {
    const IrradianceSh turned = rotate(irradiance, engine_from_ours(engine));
    Coefficients radiance = radiance_from_irradiance(turned).coefficients;
    switch (engine) {
        case Engine::Unity:
        case Engine::Filament:
            return polynomial_factors(turned);
        case Engine::Unreal:
            for (size_t i = 0; i < radiance.size(); ++i) radiance[i] *= kCondonShortley[i];
            return radiance;
        case Engine::Godot:
            return scaled(radiance, std::numbers::inv_pi_v<float>);
        case Engine::ThreeJs:
            break;
    }
    return radiance;
}

glm::vec3 engine_direction(Engine engine, glm::vec3 direction) noexcept {
    return engine_from_ours(engine) * direction;
}

glm::vec3 direction_from_engine(Engine engine, glm::vec3 direction) noexcept {
    return direction * engine_from_ours(engine);  // the transpose is the inverse
}

glm::vec3 engine_position(Engine engine, glm::vec3 position) noexcept {
    return units_a_metre(engine) * engine_direction(engine, position);
}

glm::vec3 position_from_engine(Engine engine, glm::vec3 position) noexcept {
    return direction_from_engine(engine, position) / units_a_metre(engine);
}

}  // namespace tetralight
