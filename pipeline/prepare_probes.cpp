// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/prepare_probes.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include <tetralight/bake/parallel.h>
#include <tetralight/bake/probe_visibility.h>
#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/bake/virtual_offset.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/probes/build/group_spacing.h>
#include <tetralight/probes/build/remove_probes.h>

namespace tetralight {
namespace {

/// Distance of a capture position behind the surface, as a fraction of the distance to the nearest
/// probe.
constexpr double kMarginFraction = 0.02;

double scene_size(const Scene& scene) {
    const auto bounds =
        scene_bounds(scene, [](const MeshInstance& instance) { return instance.contributes_gi; });
    return bounds ? glm::length(bounds->size()) : 0.0;
}

/// Finds probes inside geometry and their virtual offsets. Arrays have one element a probe.
struct HealthSearch {
    const TraceScene& traced;
    const MergedProbes& merged;
    const HealthSettings& settings;
    uint32_t thread_count = 0;
    std::vector<ProbeHealth> health{merged.positions.size()};
    std::vector<uint8_t> is_inside = std::vector<uint8_t>(merged.positions.size(), 0);
    /// By an adjustment volume: no virtual offset is searched.
    std::vector<uint8_t> is_adjusted_inside = std::vector<uint8_t>(merged.positions.size(), 0);

    void find_inside() {
        parallel_for(health.size(), thread_count, [&](size_t i) {
            const auto found =
                probe_visibility(traced, traced.render_from_world(merged.positions[i]));
            health[i].surface_distance = found.surface_distance;
            is_inside[i] = found.is_inside(settings.min_validity);
        });
    }

    /// The validity of an adjustment volume replaces the visibility that was found.
    void apply(const std::vector<ProbeAdjustment>& adjustments) {
        for (size_t i = 0; i < is_inside.size() && !adjustments.empty(); ++i) {
            const auto validity = adjustment_at(adjustments, merged.positions[i]).validity;
            if (validity) is_inside[i] = *validity < settings.min_validity;
            is_adjusted_inside[i] = validity && is_inside[i] != 0;
        }
    }

    /// Searches virtual offsets for probes inside geometry. `max_spacing` is the spacing of a probe
    /// that is alone in its group, and the maximum for others.
    void find_virtual_offsets(double max_spacing) {
        std::vector<uint32_t> inside;
        for (uint32_t i = 0; i < is_inside.size(); ++i) {
            if (is_inside[i] != 0 && is_adjusted_inside[i] == 0) inside.push_back(i);
        }
        const std::vector<double> spacing = group_spacing(merged, inside);
        parallel_for(inside.size(), thread_count, [&](size_t i) {
            const double distance = std::min(spacing[i], max_spacing);
            const VirtualOffsetSettings offset_search{
                static_cast<float>(settings.virtual_offset * distance),
                static_cast<float>(kMarginFraction * distance), settings.min_validity};
            const glm::vec3 position = traced.render_from_world(merged.positions[inside[i]]);
            const auto offset = find_virtual_offset(traced, position, offset_search);
            if (!offset) return;
            health[inside[i]].virtual_offset = *offset;
            is_inside[inside[i]] = 0;
        });
    }
};

const char* outcome(InvalidProbes policy) {
    switch (policy) {
        case InvalidProbes::LeaveOut:
            return "and were left out";
        case InvalidProbes::Dilate:
            return "and take the light of those around them";
        case InvalidProbes::Keep:
            return "and stay dark where no light gets in";
    }
    return "";
}

std::vector<std::string> group_warnings(const MergedProbes& merged,
                                        const std::vector<uint8_t>& is_inside,
                                        InvalidProbes policy) {
    std::vector<size_t> inside(merged.group_names.size(), 0);
    std::vector<size_t> total(merged.group_names.size(), 0);
    for (const ProbeSource& source : merged.sources) {
        ++total[source.group];
        inside[source.group] += is_inside[source.probe];
    }
    std::vector<std::string> warnings;
    for (size_t g = 0; g < total.size(); ++g) {
        if (inside[g] == 0) continue;
        warnings.push_back(str_cat("group \"", merged.group_names[g], "\": ", inside[g], " of ",
                                   total[g], " probes lie inside geometry ", outcome(policy)));
    }
    return warnings;
}

template <class T>
std::vector<T> kept(const std::vector<T>& values, const std::vector<bool>& is_left_out) {
    std::vector<T> result;
    for (size_t i = 0; i < values.size(); ++i) {
        if (!is_left_out[i]) result.push_back(values[i]);
    }
    return result;
}

}  // namespace

const char* name_of(InvalidProbes policy) {
    constexpr const char* kNames[] = {"leave-out", "dilate", "keep"};
    return kNames[static_cast<size_t>(policy)];
}

PreparedProbes prepare_probes(const Scene& scene, const TraceScene& traced, MergedProbes merged,
                              const HealthSettings& settings, uint32_t thread_count) {
    HealthSearch search{traced, merged, settings, thread_count};
    search.find_inside();
    search.apply(scene.probe_adjustments);
    if (settings.virtual_offset > 0.0) search.find_virtual_offsets(scene_size(scene));

    PreparedProbes prepared;
    prepared.warnings = group_warnings(merged, search.is_inside, settings.invalid);
    std::vector<bool> is_left_out(merged.positions.size(), false);
    if (settings.invalid == InvalidProbes::LeaveOut) {
        is_left_out.assign(search.is_inside.begin(), search.is_inside.end());
    }
    prepared.health = kept(search.health, is_left_out);
    const std::vector<uint8_t> invalid = kept(search.is_inside, is_left_out);
    prepared.is_invalid.assign(invalid.begin(), invalid.end());
    prepared.left_out_count = merged.positions.size() - prepared.health.size();
    prepared.merged = remove_probes(std::move(merged), is_left_out);
    for (size_t i = 0; i < prepared.health.size(); ++i) {
        const glm::vec3 offset = prepared.health[i].virtual_offset;
        prepared.virtual_offset_count += offset != glm::vec3(0.0f);
        prepared.capture_positions.push_back(prepared.merged.positions[i] + glm::dvec3(offset));
    }
    return prepared;
}

}  // namespace tetralight
