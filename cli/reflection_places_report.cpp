// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/reflection_places_report.h>

#include <algorithm>
#include <array>
#include <charconv>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/table.h>

namespace tetralight::cli {
namespace {

/// To the centimetre.
std::string centimetres(double metres) {
    std::array<char, 64> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), metres,
                                   std::chars_format::fixed, 2);
    return {digits.data(), end.ptr};
}

std::string three_lengths(const glm::dvec3& v, const char* between) {
    return str_cat(centimetres(v.x), between, centimetres(v.y), between, centimetres(v.z));
}

}  // namespace

Json reflection_places_json(std::span<const ReflectionPlace> places) {
    Json list = Json::array();
    for (const ReflectionPlace& place : places) {
        list.push_back({{"name", place.name},
                        {"position", to_json(place.position)},
                        {"size", to_json(2.0 * glm::dvec3(place.half_size))},
                        {"blend_distance", place.blend_distance},
                        {"importance", place.importance}});
    }
    return list;
}

std::string reflection_places_text(const std::string& path,
                                   std::span<const ReflectionPlace> places) {
    if (places.empty()) {
        return path +
               ": no reflection probes; there is no room and no open ground in the filled spaces\n";
    }
    constexpr size_t kMostPlaces = 16;
    std::vector<std::vector<std::string>> rows{{"", "at", "box, m"}};
    for (size_t i = 0; i < std::min(places.size(), kMostPlaces); ++i) {
        const ReflectionPlace& place = places[i];
        rows.push_back({place.name, three_lengths(place.position, ","),
                        three_lengths(2.0 * glm::dvec3(place.half_size), " x ")});
    }
    std::string more;
    if (places.size() > kMostPlaces)
        more = str_cat("  and ", places.size() - kMostPlaces, " more\n");
    return str_cat(path, ": ", counted(places.size(), "reflection probe"), "\n",
                   aligned(rows, "lll"), more);
}

}  // namespace tetralight::cli
