// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/merge.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

#include <tetralight/base/str_cat.h>
#include <tetralight/base/utf8.h>
#include <tetralight/probes/build/detail/snap_to_lattice.h>
#include <tetralight/probes/build/detail/weld_sources.h>
#include <tetralight/probes/farthest_position.h>
#include <tetralight/probes/is_finite.h>

namespace tetralight {
namespace {

/// Returns invalid_argument for a member of a group. `merge` completes the field.
Error group_error(const ProbeGroup& group, std::string member, std::string value,
                  const std::string& message) {
    return {ErrorCode::InvalidArgument, std::move(member), std::move(value),
            str_cat("group \"", group.name, "\": ", message)};
}

Error position_error(const ProbeGroup& group, size_t index, const char* what, glm::dvec3 p) {
    const std::string value = str_cat(p.x, ", ", p.y, ", ", p.z);
    return group_error(group, str_cat("positions[", index, "]"), value,
                       str_cat("probe ", index, ": position ", what, " (", value, ")"));
}

Status check_group(const ProbeGroup& group, const ProbeGroup* previous) {
    if (group.name.empty()) {
        return Error{ErrorCode::InvalidArgument, "name", "", "a probe group has no name"};
    }
    if (const auto status = check_characters(group.name); !status) {
        Error error = status.error().in(str_cat("group \"", group.name, "\""));
        error.field = "name";
        return error;
    }
    if (previous != nullptr && previous->name == group.name) {
        return group_error(group, "name", group.name, "there are two groups of this name");
    }
    if (group.rendering_layers == 0) {
        return group_error(group, "rendering_layers", "[]", "it is on no rendering layer");
    }
    return Ok{};
}

Result<std::vector<glm::dvec3>> world_positions(const ProbeGroup& group) {
    std::vector<glm::dvec3> positions;
    positions.reserve(group.positions.size());
    for (size_t i = 0; i < group.positions.size(); ++i) {
        const glm::dvec3 p(group.world_from_group * glm::dvec4(group.positions[i], 1.0));
        if (!is_finite(group.positions[i])) {
            return position_error(group, i, "is not finite", group.positions[i]);
        }
        if (!is_finite(p) || glm::length(p) > kFarthestPosition) {
            return position_error(group, i, "in the world is beyond 1e18", p);
        }
        positions.push_back(p + 0.0);  // -0 becomes 0: equal positions have equal bits
    }
    return positions;
}

}  // namespace

std::vector<std::string> MergedProbes::lattice_group_names() const {
    std::vector<std::string> names;
    for (size_t group = 0; group < group_names.size(); ++group) {
        if (group_is_lattice[group]) names.push_back(group_names[group]);
    }
    return names;
}

size_t MergedProbes::welded_count() const {
    const auto is_there = [](const ProbeSource& source) { return source.probe != kNoIndex; };
    return static_cast<size_t>(std::ranges::count_if(sources, is_there)) - positions.size();
}

double flat_tolerance(const MergedProbes& probes) {
    return 0.5 * probes.weld_radius;
}

Result<MergedProbes> merge(std::span<const ProbeGroup> groups, const MergeSettings& settings) {
    std::vector<const ProbeGroup*> sorted;
    for (const ProbeGroup& group : groups) sorted.push_back(&group);
    std::ranges::sort(sorted, {},
                      [](const ProbeGroup* group) { return std::string_view(group->name); });

    MergedProbes merged;
    std::vector<glm::dvec3> positions;
    for (uint32_t g = 0; g < sorted.size(); ++g) {
        const ProbeGroup& group = *sorted[g];
        const auto checked = check_group(group, g > 0 ? sorted[g - 1] : nullptr);
        auto group_positions = checked ? world_positions(group) : checked.error();
        if (!group_positions) {
            Error error = group_positions.error();
            error.field.insert(0, str_cat("groups[", &group - groups.data(), "]."));
            return error;
        }
        const auto snap = detail::snap_to_lattice(*group_positions);
        merged.group_is_lattice.push_back(snap.has_value());
        merged.largest_snap = std::max(merged.largest_snap, snap.value_or(0.0));
        merged.group_names.push_back(group.name);
        merged.group_dering.push_back(group.dering);
        merged.group_rendering_layers.push_back(group.rendering_layers);
        merged.group_empty_warnings.push_back(group.empty_warning);
        for (uint32_t i = 0; i < group_positions->size(); ++i) {
            merged.sources.push_back({g, i, 0});
            positions.push_back((*group_positions)[i]);
        }
    }
    if (positions.size() >= kNoIndex / 8) {
        return Error{
            ErrorCode::InvalidArgument,
            str_cat(positions.size(), " probes are more than 32-bit cell indices can name")};
    }
    detail::weld_sources(positions, settings.weld_tolerance, merged);
    return merged;
}

}  // namespace tetralight
