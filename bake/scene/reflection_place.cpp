// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/reflection_place.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <string_view>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/base/utf8.h>

namespace tetralight {
namespace {

/// Metres, as for vertices.
constexpr double kFarthest = 1e12;

template <class Vec>
std::string text_of(const Vec& v) {
    return str_cat("[", v.x, ", ", v.y, ", ", v.z, "]");
}

template <class Vec>
bool is_near(const Vec& v) {
    return std::abs(v.x) <= kFarthest && std::abs(v.y) <= kFarthest && std::abs(v.z) <= kFarthest;
}

/// Returns invalid_argument: `NAME VALUE REASON`.
Error place_error(const char* name, std::string value, const char* reason) {
    const std::string message = str_cat(name, " ", value, reason);
    return {ErrorCode::InvalidArgument, str_cat(".", name), std::move(value), message};
}

bool is_orthonormal(const glm::mat3& axes) {
    constexpr float kRounding = 1e-4f;
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k <= i; ++k) {
            const float expected = i == k ? 1.0f : 0.0f;
            if (!(std::abs(glm::dot(axes[i], axes[k]) - expected) <= kRounding)) return false;
        }
    }
    return true;
}

}  // namespace

Status check_reflection_place(const ReflectionPlace& place) {
    constexpr const char* kTooFar = " is farther than 1e+12 m away";
    const glm::vec3& half = place.half_size;
    if (!is_near(place.position)) return place_error("position", text_of(place.position), kTooFar);
    if (!is_near(place.box_center)) {
        return place_error("box.center", text_of(place.box_center), kTooFar);
    }
    if (!(half.x > 0.0f && half.y > 0.0f && half.z > 0.0f && is_near(half))) {
        return place_error("box.half_size", text_of(half),
                           " is not three lengths above 0, up to 1e+12 m");
    }
    if (!is_orthonormal(place.axes)) {
        const std::string axes = str_cat("[", text_of(place.axes[0]), ", ", text_of(place.axes[1]),
                                         ", ", text_of(place.axes[2]), "]");
        return place_error("box.axes", axes, " are not unit vectors at right angles");
    }
    if (!(place.blend_distance >= 0.0f && place.blend_distance <= kFarthest)) {
        return place_error("blend_distance", str_cat(place.blend_distance),
                           " is not a length from 0 to 1e+12 m");
    }
    if (!(place.near_distance >= 0.0f && place.near_distance <= kFarthest)) {
        return place_error("near", str_cat(place.near_distance),
                           " is not a length from 0 to 1e+12 m");
    }
    return Ok{};
}

Status check_reflection_places(std::span<const ReflectionPlace> places) {
    std::set<std::string_view> names;
    for (size_t i = 0; i < places.size(); ++i) {
        const std::string& name = places[i].name;
        const std::string member = str_cat("reflection_probes[", i, "]");
        const auto name_error = [&](const std::string& message) {
            return Error{ErrorCode::InvalidArgument, member + ".name", name, message};
        };
        const std::string number = str_cat("reflection probe ", i, ": ");
        if (name.empty()) return name_error(number + "has no name");
        if (!is_utf8(name)) return name_error(number + "the name is not UTF-8");
        if (!names.insert(name).second) {
            return name_error(str_cat("two reflection probes are named \"", name, "\""));
        }
        if (auto status = check_reflection_place(places[i]); !status) {
            const std::string place = str_cat("reflection probe \"", name, "\"");
            return detail::in_member(status.error().in(place), member);
        }
    }
    return Ok{};
}

}  // namespace tetralight
