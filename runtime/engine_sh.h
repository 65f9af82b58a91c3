// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include <tetralight/probes/sh.h>

// Light, positions and directions in the conventions of engines. docs/embed.md has the table and
// the formula by which each engine evaluates these numbers.
//
//     const glm::vec3 at = position_from_engine(Engine::Unity, transform.position);
//     const IrradianceSh light = interpolate(volume, locate(volume, at)).irradiance;
//     upload(engine_sh(Engine::Unity, light));  // SphericalHarmonicsL2[rgb, i]

namespace tetralight {

enum class Engine {
    Unity,     ///< SphericalHarmonicsL2: left-handed, Y up, metres
    Unreal,    ///< FSHVectorRGB3: left-handed, Z up, centimetres
    Godot,     ///< LightmapGIData probes: our axes
    ThreeJs,   ///< LightProbe.sh, SphericalHarmonics3: our axes
    Filament,  ///< IndirectLight::Builder::irradiance(3, sh): our axes
};

/// Nine RGB coefficients in an engine's own scale, signs, order and axes.
[[nodiscard]] std::array<glm::vec3, kShCoefficientCount> engine_sh(
    Engine engine, const IrradianceSh& irradiance) noexcept;

/// A direction in the engine's axes, and back.
[[nodiscard]] glm::vec3 engine_direction(Engine engine, glm::vec3 direction) noexcept;
[[nodiscard]] glm::vec3 direction_from_engine(Engine engine, glm::vec3 direction) noexcept;

/// A position in the engine's axes and unit, and back.
[[nodiscard]] glm::vec3 engine_position(Engine engine, glm::vec3 position) noexcept;
[[nodiscard]] glm::vec3 position_from_engine(Engine engine, glm::vec3 position) noexcept;

}  // namespace tetralight
