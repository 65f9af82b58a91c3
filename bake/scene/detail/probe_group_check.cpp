// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/probe_group_check.h>

#include <cmath>
#include <set>
#include <utility>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/base/utf8.h>
#include <tetralight/probes/is_finite.h>

namespace tetralight::detail {
namespace {

Error transform_error(int index, double value, std::string message) {
    return {ErrorCode::Corrupt, str_cat(".transform[", index, "]"), str_cat(value),
            std::move(message)};
}

Status check_transform(const glm::dmat4& world_from_group) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            const double value = world_from_group[column][row];
            if (!std::isfinite(value)) {
                return transform_error(column * 4 + row, value,
                                       str_cat("transform: number ", column * 4 + row,
                                               " is not finite (", value, ")"));
            }
            if (row == 3 && value != (column == 3 ? 1.0 : 0.0)) {
                return transform_error(column * 4 + row, value,
                                       str_cat("transform is not affine: number ", column * 4 + row,
                                               " is ", value, ", not ", column == 3 ? 1 : 0));
            }
        }
    }
    return Ok{};
}

Status check_group(const ProbeGroup& group) {
    if (group.rendering_layers == 0) {
        return Error{ErrorCode::Corrupt, ".rendering_layers", "[]",
                     "rendering_layers names no layer"};
    }
    const auto transform = check_transform(group.world_from_group);
    if (!transform) return transform;
    for (size_t probe = 0; probe < group.positions.size(); ++probe) {
        const glm::dvec3& position = group.positions[probe];
        if (is_finite(position)) continue;
        const std::string value = str_cat(position.x, ", ", position.y, ", ", position.z);
        return Error{ErrorCode::Corrupt, str_cat(".positions[", probe, "]"), value,
                     str_cat("probe ", probe, ": position is not finite (", value, ")")};
    }
    return Ok{};
}

}  // namespace

std::string group_place(size_t group_index, const std::string& name) {
    return name.empty() ? str_cat("group ", group_index) : str_cat("group \"", name, "\"");
}

Status check_writable_groups(std::span<const ProbeGroup> groups) {
    if (groups.empty()) {
        return Error{ErrorCode::InvalidArgument, "there are no probe groups to write"};
    }
    if (auto status = check_probe_groups(groups); !status) return status;
    for (size_t i = 0; i < groups.size(); ++i) {
        if (is_utf8(groups[i].name)) continue;
        return Error{ErrorCode::InvalidArgument, str_cat("groups[", i, "].name"), groups[i].name,
                     str_cat("group \"", groups[i].name, "\": the name is not UTF-8")};
    }
    return Ok{};
}

Status check_probe_groups(std::span<const ProbeGroup> groups) {
    std::set<std::string_view> names;
    for (size_t i = 0; i < groups.size(); ++i) {
        const ProbeGroup& group = groups[i];
        const std::string member = str_cat("groups[", i, "]");
        if (group.name.empty()) {
            return Error{ErrorCode::Corrupt, member + ".name", "",
                         str_cat("group ", i, ": name is empty")};
        }
        if (!names.insert(group.name).second) {
            return Error{ErrorCode::Corrupt, member + ".name", group.name,
                         str_cat("group ", i, ": another group is named \"", group.name, "\"")};
        }
        const auto status = check_group(group);
        if (!status) return in_member(status.error().in(group_place(i, group.name)), member);
    }
    return Ok{};
}

}  // namespace tetralight::detail
