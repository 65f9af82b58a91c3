// SPDX-License-Identifier: Apache-2.0
#include <tetralight/engines/detail/place_light.h>

#include <numbers>

#include <tetralight/bake/scene/image_based_light_glb.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/engines/detail/probe_light.h>
#include <tetralight/engines/detail/xyz_text.h>
#include <tetralight/engines/sampled_grid.h>

namespace tetralight::detail {
namespace {

/// The constants of the basis functions (docs/conventions.md), ÷ π.
constexpr float kK0 = 0.28209479f * std::numbers::inv_pi_v<float>;
constexpr float kK1 = 0.48860251f * std::numbers::inv_pi_v<float>;
constexpr float kK2 = 1.09254843f * std::numbers::inv_pi_v<float>;
constexpr float kK20 = 0.31539157f * std::numbers::inv_pi_v<float>;
constexpr float kK22 = 0.54627422f * std::numbers::inv_pi_v<float>;

}  // namespace

const EngineSh kPlayCanvasSh{{0, 3, 1, 2, 7, 5, 4, 6, 8},
                             {kK0, kK1, kK1, kK1, kK2, kK2, kK2, kK20, kK22}};
const EngineSh kFilamentSh{{0, 1, 2, 3, 4, 5, 6, 7, 8},
                           {kK0, kK1, kK1, kK1, kK2, kK2, kK20, kK2, kK22}};
const EngineSh kBabylonSh{{0, 1, 2, 3, 4, 5, 6, 7, 8}, kImageBasedLightSigns};

std::array<glm::vec3, kShCoefficientCount> coefficients_of(const EngineSh& engine,
                                                           const IrradianceSh& light) {
    std::array<glm::vec3, kShCoefficientCount> coefficients{};
    for (size_t i = 0; i < coefficients.size(); ++i) {
        coefficients[i] = engine.factors[i] * light.coefficients[engine.order[i]];
    }
    return coefficients;
}

std::vector<PlaceLight> light_of_places(const ProbeVolumeView& volume,
                                        const ExportSettings& settings) {
    std::vector<PlaceLight> places;
    for (const glm::dvec3& position : settings.places) {
        places.push_back({position, light_at(volume, position, Walls::HideProbes)});
    }
    if (!places.empty()) return places;
    const auto light = probe_light(volume);
    for (uint32_t probe = 0; probe < volume.probe_count(); ++probe) {
        places.push_back({world_position(volume, probe), light[probe]});
    }
    return places;
}

Result<PlaceLight> light_of_one_place(const ProbeVolumeView& volume,
                                      const ExportSettings& settings) {
    if (settings.places.size() > 1) {
        return Error{ErrorCode::InvalidArgument, "places", str_cat(settings.places.size()),
                     str_cat("the format holds the light of one place, and there are ",
                             settings.places.size())};
    }
    const glm::dvec3 position =
        settings.places.empty() ? world_bounds(volume).center() : settings.places[0];
    return PlaceLight{position, light_at(volume, position, Walls::HideProbes)};
}

std::string other_places_are_lost(const PlaceLight& place) {
    const glm::vec3 p(place.position);  // shorter than doubles
    return str_cat("The light of all places but ", xyz_text(p), '.');
}

}  // namespace tetralight::detail
