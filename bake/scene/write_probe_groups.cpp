// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <nlohmann/json.hpp>

#include <tetralight/bake/scene/detail/json_members.h>
#include <tetralight/bake/scene/detail/probe_group_check.h>
#include <tetralight/bake/scene/probe_groups_json.h>
#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

/// A finite double as JSON that reads back to the same bits: "-0" would read as the integer 0.
std::string json_number(double value) {
    return value == 0.0 && std::signbit(value) ? "-0.0" : str_cat(value);
}

void append_transform(std::string& out, const glm::dmat4& transform) {
    out += "      \"transform\": [";
    for (int i = 0; i < 16; ++i) {
        if (i > 0) out += ", ";
        out += json_number(transform[i / 4][i % 4]);
    }
    out += "],\n";
}

void append_group(std::string& out, const ProbeGroup& group) {
    out += str_cat("    {\n      \"name\": ", nlohmann::json(group.name).dump(), ",\n");
    append_transform(out, group.world_from_group);
    out += str_cat("      \"dering\": ", group.dering ? "true" : "false", ",\n");
    if (group.rendering_layers != kAllRenderingLayers) {
        const nlohmann::json layers = detail::rendering_layer_list(group.rendering_layers);
        out += str_cat("      \"rendering_layers\": ", layers.dump(), ",\n");
    }
    out += "      \"positions\": [\n";
    for (const glm::dvec3& position : group.positions) {
        const bool is_last = &position == &group.positions.back();
        out += str_cat("        [", json_number(position.x), ", ", json_number(position.y), ", ",
                       json_number(position.z), is_last ? "]\n" : "],\n");
    }
    out += "      ]\n    }";
}

std::string json_text(std::span<const ProbeGroup> groups) {
    std::string out = "{\n  \"groups\": [\n";
    for (const ProbeGroup& group : groups) {
        append_group(out, group);
        out += &group == &groups.back() ? "\n" : ",\n";
    }
    return out + "  ]\n}\n";
}

}  // namespace

Status write_probe_groups(const std::string& path, std::span<const ProbeGroup> groups) {
    const auto status = detail::check_writable_groups(groups);
    if (!status) return status.error().in(path);
    const std::string out = json_text(groups);
    return write_file(path, std::as_bytes(std::span(out)));
}

}  // namespace tetralight
