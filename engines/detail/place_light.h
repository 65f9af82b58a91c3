// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/engines/export_target.h>
#include <tetralight/probes/probe_volume.h>

// The light of single places, and the form in which each engine holds it.

namespace tetralight::detail {

struct PlaceLight {
    glm::dvec3 position{0.0};
    IrradianceSh light;
};

/// The light of `settings.places`, or else of every probe.
[[nodiscard]] std::vector<PlaceLight> light_of_places(const ProbeVolumeView& volume,
                                                      const ExportSettings& settings);

/// The light of the place of `settings`, or else of the center of the probes' box. Returns
/// invalid_argument (field "places") if there are several places.
[[nodiscard]] Result<PlaceLight> light_of_one_place(const ProbeVolumeView& volume,
                                                    const ExportSettings& settings);

/// What a format loses that holds one place: a sentence.
[[nodiscard]] std::string other_places_are_lost(const PlaceLight& place);

/// The coefficients of an engine: number i is `factors[i]` times coefficient `order[i]` of the
/// irradiance (docs/conventions.md).
struct EngineSh {
    std::array<uint8_t, kShCoefficientCount> order;
    std::array<float, kShCoefficientCount> factors;
};

/// E / π as a polynomial of the normal's 1, x, y, z, xz, yz, xy, 3z² − 1, x² − y²: `ambientSH` of
/// PlayCanvas' shaders (chunks/lit/frag/ambient.js).
extern const EngineSh kPlayCanvasSh;

/// E / π as a polynomial of 1, y, z, x, xy, yz, 3z² − 1, xz, x² − y²: Filament's "irradiance,
/// pre-scaled base" (IndirectLight.h, light_indirect.fs).
extern const EngineSh kFilamentSh;

/// E_i with the signs that Babylon.js' loader of EXT_lights_image_based expects
/// (`kImageBasedLightSigns`).
extern const EngineSh kBabylonSh;

[[nodiscard]] std::array<glm::vec3, kShCoefficientCount> coefficients_of(const EngineSh& engine,
                                                                         const IrradianceSh& light);

}  // namespace tetralight::detail
