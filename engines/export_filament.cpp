// SPDX-License-Identifier: Apache-2.0
// The text of Filament's tool cmgen (`--sh-shader`): nine lines, one coefficient each, which its
// samples read with the pattern "(%f,%f,%f)". What follows in a line is a comment.
#include <array>
#include <cstdio>

#include <tetralight/engines/detail/place_light.h>
#include <tetralight/engines/detail/targets.h>

namespace tetralight::detail {
namespace {

constexpr std::array<const char*, kShCoefficientCount> kBands{"L00",  "L1-1", "L10", "L11", "L2-2",
                                                              "L2-1", "L20",  "L21", "L22"};

std::string coefficient_line(const glm::vec3& c, const char* band) {
    std::array<char, 256> line{};
    std::snprintf(line.data(), line.size(),
                  "(%18.15f, %18.15f, %18.15f); // %s, irradiance, pre-scaled base\n", c.r, c.g,
                  c.b, band);
    return line.data();
}

}  // namespace

Result<ExportedVolume> export_filament(const ProbeVolumeView& volume,
                                       const ExportSettings& settings) {
    const auto place = light_of_one_place(volume, settings);
    if (!place) return place.error();
    const auto coefficients = coefficients_of(kFilamentSh, place->light);
    std::string text;
    for (size_t i = 0; i < coefficients.size(); ++i) {
        text += coefficient_line(coefficients[i], kBands[i]);
    }
    return ExportedVolume{
        {{settings.name + ".txt", std::move(text)}}, {other_places_are_lost(*place)}, {}};
}

}  // namespace tetralight::detail
