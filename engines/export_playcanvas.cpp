// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/str_cat.h>
#include <tetralight/engines/detail/place_light.h>
#include <tetralight/engines/detail/targets.h>
#include <tetralight/engines/detail/xyz_text.h>

namespace tetralight::detail {

Result<ExportedVolume> export_playcanvas(const ProbeVolumeView& volume,
                                         const ExportSettings& settings) {
    std::string text =
        "{\n  \"format\": \"tetralight playcanvas\",\n  \"version\": 1,\n  \"places\": [";
    const char* separator = "\n";
    for (const PlaceLight& place : light_of_places(volume, settings)) {
        const glm::dvec3& p = place.position;
        text += str_cat(separator, "    {\"position\": [", xyz_text(p), "], \"ambientSH\": [");
        const char* comma = "";
        for (const glm::vec3& c : coefficients_of(kPlayCanvasSh, place.light)) {
            text += str_cat(comma, c.r, ", ", c.g, ", ", c.b);
            comma = ", ";
        }
        text += "]}";
        separator = ",\n";
    }
    text += "\n  ]\n}\n";
    return ExportedVolume{{{settings.name + ".json", std::move(text)}}, {}, {}};
}

}  // namespace tetralight::detail
