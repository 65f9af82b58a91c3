// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/reflection_places_json.h>

#include <nlohmann/json.hpp>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/bake/scene/detail/json_members.h>
#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

using detail::in_member;
using detail::wrong_type;
using nlohmann::json;

constexpr const char* kList = "reflection_probes";

Status read_axes(const json& box, glm::mat3& axes) {
    const auto value = box.find("axes");
    if (value == box.end()) return Ok{};
    const auto error = [&] { return wrong_type(*value, "axes", "three times three numbers"); };
    if (!value->is_array() || value->size() != 3) return error();
    for (int i = 0; i < 3; ++i) {
        const auto axis = detail::read_vec3((*value)[static_cast<size_t>(i)]);
        if (!axis) return error();
        axes[i] = glm::vec3(*axis);
    }
    return Ok{};
}

Status read_box(const json& object, ReflectionPlace& place) {
    const auto box = object.find("box");
    if (box == object.end()) return Ok{};
    if (!box->is_object()) return wrong_type(*box, "box", "an object");
    glm::dvec3 center(place.box_center), half_size(place.half_size);
    Status status = detail::check_keys(*box, {"center", "half_size", "axes"});
    if (status) status = detail::read_vec3(*box, "center", center);
    if (status) status = detail::read_vec3(*box, "half_size", half_size);
    if (status) status = read_axes(*box, place.axes);
    if (!status) return in_member(status.error().in("box"), ".box");
    place.box_center = glm::vec3(center);
    place.half_size = glm::vec3(half_size);
    return Ok{};
}

Status read_place_members(const json& object, ReflectionPlace& place) {
    if (!object.contains("position")) {
        return Error{ErrorCode::Corrupt, ".position", "", "position is missing"};
    }
    if (auto s = detail::read_vec3(object, "position", place.position); !s) return s;
    if (auto s = read_box(object, place); !s) return s;
    std::optional<float> blend_distance, near_distance;
    if (auto s = detail::read_number(object, "blend_distance", blend_distance); !s) return s;
    if (auto s = detail::read_number(object, "near", near_distance); !s) return s;
    place.blend_distance = blend_distance.value_or(place.blend_distance);
    place.near_distance = near_distance.value_or(place.near_distance);
    if (const auto value = object.find("importance"); value != object.end()) {
        const auto importance = detail::read_int32(*value);
        if (!importance) {
            return wrong_type(*value, "importance", "an integer from -2147483648 to 2147483647");
        }
        place.importance = *importance;
    }
    return check_reflection_place(place);
}

Result<ReflectionPlace> read_one_place(const json& object, size_t index) {
    const std::string number = str_cat("reflection probe ", index);
    if (!object.is_object()) {
        return Error{ErrorCode::Corrupt, "", detail::shown_json(object),
                     number + ": is not an object"};
    }
    const auto name = object.find("name");
    if (name == object.end() || !name->is_string() || name->get<std::string>().empty()) {
        return Error{ErrorCode::Corrupt, ".name", "", number + ": has no name"};
    }
    ReflectionPlace place;
    place.name = name->get<std::string>();
    Status status = detail::check_keys(
        object, {"name", "position", "box", "blend_distance", "importance", "near"});
    if (status) status = read_place_members(object, place);
    if (!status) return status.error().in(str_cat("reflection probe \"", place.name, "\""));
    return place;
}

Result<std::vector<ReflectionPlace>> read_places(const json& document) {
    if (!document.is_object()) return Error{ErrorCode::Corrupt, "is not a JSON object"};
    if (auto status = detail::check_keys(document, {kList}); !status) return status.error();
    const auto values = document.find(kList);
    if (values == document.end() || !values->is_array()) {
        return Error{ErrorCode::Corrupt, kList, "", str_cat(kList, " is missing or not an array")};
    }
    std::vector<ReflectionPlace> places;
    for (const json& value : *values) {
        auto place = read_one_place(value, places.size());
        if (!place) return in_member(place.error(), str_cat(kList, "[", places.size(), "]"));
        places.push_back(std::move(*place));
    }
    if (auto status = check_reflection_places(places); !status) return status.error();
    return places;
}

template <class Vec>
std::string list_of(const Vec& v) {
    return str_cat("[", v.x, ", ", v.y, ", ", v.z, "]");
}

std::string text_of_place(const ReflectionPlace& place) {
    std::string axes;
    if (place.axes != glm::mat3(1.0f)) {
        axes = str_cat(", \"axes\": [", list_of(place.axes[0]), ", ", list_of(place.axes[1]), ", ",
                       list_of(place.axes[2]), "]");
    }
    return str_cat("    {\n      \"name\": ", json(place.name).dump(),
                   ",\n      \"position\": ", list_of(place.position),
                   ",\n      \"box\": {\"center\": ", list_of(place.box_center),
                   ", \"half_size\": ", list_of(place.half_size), axes,
                   "},\n      \"blend_distance\": ", place.blend_distance,
                   ",\n      \"importance\": ", place.importance,
                   ",\n      \"near\": ", place.near_distance, "\n    }");
}

}  // namespace

Result<std::vector<ReflectionPlace>> read_reflection_places_json(const std::string& path) {
    const auto file = MappedFile::open(path);
    if (!file) return file.error();
    const auto document = detail::parse_json(file->bytes());
    if (!document) return in_member(document.error().in(path), "");
    auto places = read_places(*document);
    if (!places) return in_member(places.error().in(path), "");
    return places;
}

Status write_reflection_places_json(const std::string& path,
                                    std::span<const ReflectionPlace> places) {
    if (auto status = check_reflection_places(places); !status) return status.error().in(path);
    std::string out = str_cat("{\n  \"", kList, "\": [\n");
    for (const ReflectionPlace& place : places) {
        out += text_of_place(place);
        out += &place == &places.back() ? "\n" : ",\n";
    }
    out += "  ]\n}\n";
    return write_file(path, std::as_bytes(std::span(out)));
}

}  // namespace tetralight
