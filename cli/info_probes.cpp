// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/info_probes.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/amounts.h>
#include <tetralight/cli/table.h>
#include <tetralight/pipeline/prepare_probes.h>
#include <tetralight/probes/rendering_layers.h>

namespace tetralight::cli {
namespace {

constexpr float kMeanOfBand0 = 0.28209479f;  // E(n) over all normals is E_0 times this

/// What is known of one probe.
struct ProbeFacts {
    std::vector<std::string> groups;
    glm::dvec3 position{0.0};
    float validity = 1.0f;
    ProbeHealth health;
    glm::vec3 irradiance{0.0f};
    std::vector<uint32_t> rendering_layers;
    std::vector<std::string> flags;
};

/// A probe is `buried` when it looks from inside geometry by the threshold of its bake.
float min_validity(const ProbeVolumeView& volume) {
    const Json recipe = made_with(volume);
    const HealthSettings defaults;
    if (recipe.is_null()) return defaults.min_validity;
    const auto value = recipe.find("min_validity");
    const bool is_there = value != recipe.end() && value->is_number();
    return is_there ? value->get<float>() : defaults.min_validity;
}

std::vector<std::string> flags(const ProbeFacts& probe, bool is_baked, float least_validity) {
    std::vector<std::string> flags;
    if (probe.health.virtual_offset != glm::vec3(0.0f)) flags.emplace_back("moved");
    if (probe.validity < least_validity) flags.emplace_back("buried");
    if (probe.health.is_dilated != 0) flags.emplace_back("dilated");
    if (is_baked && probe.irradiance == glm::vec3(0.0f)) flags.emplace_back("dark");
    return flags;
}

/// The layers of a mask, ascending.
std::vector<uint32_t> layers_of(uint32_t mask) {
    std::vector<uint32_t> layers;
    for (uint32_t i = 0; i < kRenderingLayerCount; ++i) {
        if ((mask >> i & 1) != 0) layers.push_back(i);
    }
    return layers;
}

std::vector<ProbeFacts> probe_facts(const ProbeVolumeView& volume) {
    std::vector<ProbeFacts> facts(volume.probe_count());
    const auto names = split_names(volume.group_names);
    for (const ProbeSource& source : volume.sources) {
        if (source.probe == kNoIndex) continue;
        auto& groups = facts[source.probe].groups;
        const std::string name(names[source.group]);
        if (groups.empty() || groups.back() != name) groups.push_back(name);
    }
    const float least_validity = min_validity(volume);
    for (uint32_t i = 0; i < facts.size(); ++i) {
        ProbeFacts& probe = facts[i];
        probe.position = glm::dvec3(volume.positions[i]) + volume.info.world_origin;
        if (!volume.exact_positions.empty()) probe.position = volume.exact_positions[i];
        if (!volume.validity.empty()) probe.validity = volume.validity[i];
        if (!volume.health.empty()) probe.health = volume.health[i];
        const bool is_baked = !volume.irradiance.empty();
        if (is_baked) probe.irradiance = kMeanOfBand0 * volume.irradiance[i].coefficients[0];
        if (!volume.rendering_layers.empty()) {
            probe.rendering_layers = layers_of(volume.rendering_layers[i]);
        }
        probe.flags = flags(probe, is_baked, least_validity);
    }
    return facts;
}

/// Null where the volume does not say.
template <class T>
Json known(bool is_known, const T& value) {
    return is_known ? Json(value) : Json(nullptr);
}

Json probe_json(uint32_t index, const ProbeFacts& probe, const ProbeVolumeView& volume) {
    const bool has_health = !volume.health.empty();
    const float error = probe.health.standard_error, distance = probe.health.surface_distance;
    return {{"index", index},
            {"groups", probe.groups},
            {"position", to_json(probe.position)},
            {"validity", known(!volume.validity.empty(), probe.validity)},
            {"standard_error", known(has_health && error > 0.0f, error)},
            {"surface_distance", known(has_health && std::isfinite(distance), distance)},
            {"capture_offset", known(has_health, to_json(glm::dvec3(probe.health.virtual_offset)))},
            {"mean_irradiance",
             known(!volume.irradiance.empty(), to_json(glm::dvec3(probe.irradiance)))},
            {"rendering_layers", known(!volume.rendering_layers.empty(), probe.rendering_layers)},
            {"flags", probe.flags}};
}

std::string number(const char* format, float value) {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, format, static_cast<double>(value));
    return buffer;
}

std::vector<std::string> probe_row(uint32_t index, const ProbeFacts& probe,
                                   const ProbeVolumeView& volume) {
    const bool has_health = !volume.health.empty(), is_baked = !volume.irradiance.empty();
    const ProbeHealth& health = probe.health;
    const float offset = glm::length(health.virtual_offset);
    std::vector<std::string> row{str_cat(index)};
    for (int axis = 0; axis < 3; ++axis) {
        row.push_back(number("%.6g", static_cast<float>(probe.position[axis])));
    }
    row.push_back(volume.validity.empty() ? "-" : number("%.3f", probe.validity));
    row.push_back(health.standard_error > 0.0f ? number("%.2f %%", 100 * health.standard_error)
                                               : "-");
    row.push_back(has_health ? number("%.3g", health.surface_distance) : "-");
    row.push_back(offset > 0.0f ? number("%.3g", offset) : "-");
    for (int channel = 0; channel < 3; ++channel) {
        row.push_back(is_baked ? number("%.4g", probe.irradiance[channel]) : "-");
    }
    row.push_back(printable(joined(probe.groups)));
    row.push_back(joined(probe.flags));
    return row;
}

}  // namespace

size_t left_out_count(const ProbeVolumeView& volume) {
    return static_cast<size_t>(std::ranges::count(volume.sources, kNoIndex, &ProbeSource::probe));
}

Json probes_json(const ProbeVolumeView& volume) {
    Json probes = Json::array(), left_out = Json::array();
    const auto facts = probe_facts(volume);
    for (uint32_t i = 0; i < facts.size(); ++i) probes.push_back(probe_json(i, facts[i], volume));
    const auto names = split_names(volume.group_names);
    for (const ProbeSource& source : volume.sources) {
        if (source.probe != kNoIndex) continue;
        left_out.push_back({{"group", names[source.group]}, {"index", source.index}});
    }
    return {{"probe_list", probes}, {"left_out_list", left_out}};
}

std::string probes_text(const ProbeVolumeView& volume) {
    std::vector<std::vector<std::string>> rows{{"probe", "x", "y", "z", "validity", "error",
                                                "surface", "offset", "mean r", "g", "b", "groups",
                                                "flags"}};
    const auto facts = probe_facts(volume);
    for (uint32_t i = 0; i < facts.size(); ++i) rows.push_back(probe_row(i, facts[i], volume));
    std::string lines = aligned(rows, "rrrrrrrrrrrll");
    lines.pop_back();
    return lines;
}

}  // namespace tetralight::cli
