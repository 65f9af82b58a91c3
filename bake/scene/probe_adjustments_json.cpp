// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/probe_adjustments_json.h>

#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/bake/scene/detail/json_members.h>
#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

using detail::check_keys;
using detail::in_member;
using detail::read_number;
using detail::read_vec3;
using detail::shown_json;
using detail::wrong_type;
using nlohmann::json;

/// An error of `check_adjustment`, whose field names a key of the volume.
Error relative(Error error) {
    if (!error.field.empty()) error.field = str_cat(".", error.field);
    return error;
}

Status read_place(const json& object, ProbeAdjustment& adjustment) {
    const auto shape = object.find("shape");
    if (shape == object.end()) {
        return Error{ErrorCode::Corrupt, ".shape", "", "shape is missing"};
    }
    const bool is_box = *shape == "box";
    if (!is_box && *shape != "sphere") {
        const std::string shown = shown_json(*shape);
        return Error{ErrorCode::InvalidArgument, ".shape", shown,
                     str_cat("shape ", shown, " is not \"box\" or \"sphere\"")};
    }
    const char* other = is_box ? "radius" : "size";
    if (object.contains(other)) {
        return Error{ErrorCode::InvalidArgument, str_cat(".", other), shown_json(object[other]),
                     str_cat(other, " does not fit the shape")};
    }
    glm::dvec3 center(0.0), size(1.0);
    std::optional<double> radius;
    if (auto status = read_vec3(object, "center", center); !status) return status;
    if (auto status = read_vec3(object, "size", size); !status) return status;
    if (auto status = read_number(object, "radius", radius); !status) return status;
    adjustment.shape = is_box ? AdjustmentShape::Box : AdjustmentShape::Sphere;
    if (!is_box) size = glm::dvec3(radius.value_or(1.0));
    if (auto status = check_adjustment_size(adjustment.shape, size); !status) {
        return relative(status.error());
    }
    adjustment.world_from_volume = glm::scale(glm::translate(glm::dmat4(1.0), center), size);
    return Ok{};
}

Status read_settings(const json& object, ProbeAdjustment& adjustment) {
    if (const auto forbid = object.find("forbid"); forbid != object.end()) {
        if (!forbid->is_boolean()) return wrong_type(*forbid, "forbid", "a boolean");
        adjustment.forbids_probes = forbid->get<bool>();
    }
    if (auto s = read_number(object, "spacing", adjustment.spacing); !s) return s;
    if (auto s = read_number(object, "validity", adjustment.validity); !s) return s;
    if (const auto layers = object.find("rendering_layers"); layers != object.end()) {
        const auto mask = detail::read_rendering_layers(*layers, "rendering_layers");
        if (!mask) return mask.error();
        adjustment.rendering_layers = *mask;
    }
    return read_number(object, "intensity", adjustment.intensity);
}

Result<ProbeAdjustment> read_adjustment(const json& object, size_t index) {
    const std::string place = str_cat("adjustment ", index);
    if (!object.is_object()) {
        return Error{ErrorCode::Corrupt, "", shown_json(object), place + ": is not an object"};
    }
    const auto name = object.find("name");
    if (name == object.end() || !name->is_string() || name->get<std::string>().empty()) {
        return Error{ErrorCode::Corrupt, ".name", "", place + ": has no name"};
    }
    ProbeAdjustment adjustment;
    adjustment.name = name->get<std::string>();
    Status status = check_keys(object, {"name", "shape", "center", "size", "radius", "forbid",
                                        "spacing", "validity", "intensity", "rendering_layers"});
    if (status) status = read_place(object, adjustment);
    if (status) status = read_settings(object, adjustment);
    if (!status) return status.error().in(str_cat("adjustment volume \"", adjustment.name, "\""));
    if (status = check_adjustment(adjustment); !status) return relative(status.error());
    return adjustment;
}

Result<std::vector<ProbeAdjustment>> read_adjustments(const json& document) {
    if (!document.is_object()) return Error{ErrorCode::Corrupt, "is not a JSON object"};
    if (auto status = check_keys(document, {"adjustments"}); !status) return status.error();
    const auto values = document.find("adjustments");
    if (values == document.end() || !values->is_array()) {
        return Error{ErrorCode::Corrupt, "adjustments", "",
                     "adjustments is missing or not an array"};
    }
    std::vector<ProbeAdjustment> adjustments;
    std::set<std::string> names;
    for (const json& value : *values) {
        auto adjustment = read_adjustment(value, adjustments.size());
        const std::string member = str_cat("adjustments[", adjustments.size(), "]");
        if (!adjustment) return in_member(adjustment.error(), member);
        if (!names.insert(adjustment->name).second) {
            return Error{ErrorCode::Corrupt, member + ".name", adjustment->name,
                         str_cat("two adjustment volumes are named \"", adjustment->name, "\"")};
        }
        adjustments.push_back(std::move(*adjustment));
    }
    return adjustments;
}

}  // namespace

Result<std::vector<ProbeAdjustment>> read_probe_adjustments(const std::string& path) {
    const auto file = MappedFile::open(path);
    if (!file) return file.error();
    const auto document = detail::parse_json(file->bytes());
    if (!document) return in_member(document.error().in(path), "");
    auto adjustments = read_adjustments(*document);
    if (!adjustments) return in_member(adjustments.error().in(path), "");
    return adjustments;
}

}  // namespace tetralight
