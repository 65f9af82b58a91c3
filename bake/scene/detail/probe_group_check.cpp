// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/probe_group_check.h>

#include <cmath>
#include <set>

#include <tetralight/base/str_cat.h>
#include <tetralight/probes/is_finite.h>

namespace tetralight::detail {
namespace {

Status check_transform(const glm::dmat4& world_from_group) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            const double value = world_from_group[column][row];
            if (!std::isfinite(value)) {
                return Error{str_cat("transform: number ", column * 4 + row, " is not finite (",
                                     value, ")")};
            }
            if (row == 3 && value != (column == 3 ? 1.0 : 0.0)) {
                return Error{str_cat("transform is not affine: number ", column * 4 + row, " is ",
                                     value, ", not ", column == 3 ? 1 : 0)};
            }
        }
    }
    return Ok{};
}

Status check_group(const ProbeGroup& group) {
    const auto transform = check_transform(group.world_from_group);
    if (!transform) return transform;
    for (size_t probe = 0; probe < group.positions.size(); ++probe) {
        const glm::dvec3& position = group.positions[probe];
        if (is_finite(position)) continue;
        return Error{str_cat("probe ", probe, ": position is not finite (", position.x, ", ",
                             position.y, ", ", position.z, ")")};
    }
    return Ok{};
}

}  // namespace

std::string group_place(size_t group_index, const std::string& name) {
    return name.empty() ? str_cat("group ", group_index) : str_cat("group \"", name, "\"");
}

Status check_probe_groups(std::span<const ProbeGroup> groups) {
    std::set<std::string_view> names;
    for (size_t i = 0; i < groups.size(); ++i) {
        const ProbeGroup& group = groups[i];
        if (group.name.empty()) return Error{str_cat("group ", i, ": name is empty")};
        if (!names.insert(group.name).second) {
            return Error{str_cat("group ", i, ": another group is named \"", group.name, "\"")};
        }
        const auto status = check_group(group);
        if (!status) return status.error().in(group_place(i, group.name));
    }
    return Ok{};
}

}  // namespace tetralight::detail
