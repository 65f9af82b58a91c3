// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/reuse_probes.h>

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

#include <tetralight/base/contract.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/probes/content_hash.h>

namespace tetralight {
namespace {

using Json = nlohmann::json;
using PositionBits = std::array<uint64_t, 3>;

PositionBits bits_of(const glm::dvec3& position) {
    return {std::bit_cast<uint64_t>(position.x), std::bit_cast<uint64_t>(position.y),
            std::bit_cast<uint64_t>(position.z)};
}

/// Arrays that a baked volume has, and all of them.
Status check_arrays(const ProbeVolumeView& old) {
    const size_t count = old.positions.size();
    const auto is_missing = [&](const auto& array, bool is_needed = true) {
        return is_needed && array.size() < count;
    };
    if (is_missing(old.irradiance)) return Error{"it has no light"};
    if (is_missing(old.validity) || is_missing(old.health) || is_missing(old.exact_positions) ||
        is_missing(old.occlusion, !old.occlusion_lights.empty()) ||
        is_missing(old.layer_irradiance, !old.layers.empty()) ||
        is_missing(old.transfer, !old.sky.empty())) {
        return Error{"a section is missing"};
    }
    return Ok{};
}

std::string difference(const std::string& member, const Json& old, const Json& fresh) {
    if (member == "scene") return "it is of another scene, sky or sun";
    if (member == "adjustments") return "its adjustment volumes are others";
    if (member == "generator")
        return str_cat("it was made by ", old.dump(), ", not by ", fresh.dump());
    if (member == "relit") return str_cat("it was relit with ", old.dump());
    const auto value = [](const Json& json) {
        return json.is_null() ? std::string("not set") : json.dump();
    };
    return str_cat("its ", member, " is ", value(old), ", that of this bake is ", value(fresh));
}

/// Both volumes say how they were made. Of dering each probe has its own record.
Status check_recipe(std::string_view old, std::string_view fresh) {
    Json there = Json::parse(old, nullptr, false);
    Json here = Json::parse(fresh, nullptr, false);
    if (!there.is_object() || !there.contains("scene")) {
        return Error{"it does not say what scene it is of"};
    }
    there.erase("dering");
    here.erase("dering");
    if (there == here) return Ok{};
    Json all = here;
    all.update(there);
    for (const char* first : {"generator", "scene", "adjustments", "relit"}) {
        const Json a = there.value(first, Json()), b = here.value(first, Json());
        if (a != b) return Error{difference(first, a, b)};
    }
    for (const auto& [member, ignored] : all.items()) {
        const Json a = there.value(member, Json()), b = here.value(member, Json());
        if (a != b) return Error{difference(member, a, b)};
    }
    return Ok{};
}

std::string listed(const ProbeVolumeView& volume) {
    std::string names;
    for (const std::string_view name : split_names(volume.layer_names)) {
        names += str_cat(names.empty() ? "" : ", ", name);
    }
    if (!volume.sky.empty()) names += str_cat(names.empty() ? "" : ", ", "transfer");
    return names.empty() ? "none" : names;
}

Status check_same_bake(const ProbeVolumeView& old, const ProbeVolumeView& fresh) {
    if (auto status = check_arrays(old); !status) return status;
    if (auto status = check_recipe(old.metadata, fresh.metadata); !status) return status;
    if (listed(old) == listed(fresh)) return Ok{};
    return Error{str_cat("its layers are ", listed(old), ", those of this bake ", listed(fresh))};
}

/// One a probe: it is dilated, or lies in a cell with one that is.
std::vector<bool> near_dilated(const PreparedBake& prepared) {
    const ProbeVolume& volume = prepared.volume;
    std::vector<bool> is_near(volume.positions.size(), false);
    if (prepared.settings.health.invalid != InvalidProbes::Dilate) return is_near;
    for (const Cell& cell : std::span(volume.cells).first(volume.info.inner_cell_count)) {
        const auto is_invalid = [&](uint32_t probe) {
            return probe != kNoIndex && prepared.is_invalid[probe];
        };
        if (!std::ranges::any_of(cell.vertices, is_invalid)) continue;
        for (const uint32_t probe : cell.vertices) {
            if (probe != kNoIndex) is_near[probe] = true;
        }
    }
    return is_near;
}

/// Where a probe of a volume gathered its light.
glm::dvec3 capture_position(const ProbeVolumeView& volume, uint32_t probe) {
    return volume.exact_positions[probe] + glm::dvec3(volume.health[probe].virtual_offset);
}

std::vector<uint32_t> find_taken(const ProbeVolumeView& old, const PreparedBake& prepared) {
    std::map<PositionBits, uint32_t> old_at;
    for (uint32_t i = 0; i < old.probe_count(); ++i) old_at[bits_of(old.exact_positions[i])] = i;
    const std::vector<bool> is_near_dilated = near_dilated(prepared);
    const std::vector<uint8_t> dering = dering_marks(prepared.merged, prepared.settings.dering);
    std::vector<uint32_t> taken(prepared.capture_positions.size(), kNoIndex);
    for (size_t i = 0; i < taken.size(); ++i) {
        const auto found = old_at.find(bits_of(prepared.merged.positions[i]));
        if (found == old_at.end() || is_near_dilated[i]) continue;
        const uint32_t probe = found->second;
        const uint8_t old_dering = old.dering.empty() ? uint8_t{0} : old.dering[probe];
        const bool is_same =
            old.health[probe].is_dilated == 0 && old_dering == dering[i] &&
            bits_of(capture_position(old, probe)) == bits_of(prepared.capture_positions[i]);
        if (is_same) taken[i] = probe;
    }
    return taken;
}

}  // namespace

Status reuse_probes(const ProbeVolumeView& old, PreparedBake& prepared) {
    if (auto status = check_same_bake(old, prepared.volume.view()); !status) return status;
    prepared.reused = {old, find_taken(old, prepared)};
    return Ok{};
}

PreparedBake bake_of_others(const PreparedBake& prepared) {
    PreparedBake others;
    others.settings = prepared.settings;
    ContentHash key;
    key.add(prepared.key);
    for (uint32_t i = 0; i < prepared.capture_positions.size(); ++i) {
        if (prepared.reused.is_taken(i)) continue;
        key.add(i);
        others.capture_positions.push_back(prepared.capture_positions[i]);
        const auto& lights = prepared.volume.occlusion_lights;
        if (!lights.empty()) others.volume.occlusion_lights.push_back(lights[i]);
    }
    others.key = key.value();
    return others;
}

PartialBake spread_others(const PreparedBake& prepared, const PartialBake& others) {
    const auto count = static_cast<uint32_t>(prepared.capture_positions.size());
    const size_t row_size = LightGroupLayout(prepared.settings.bake.plan).size();
    PartialBake all{{0, count},
                    std::vector<ProbeAccumulator>(count),
                    others.is_finished,
                    std::vector<double>(count * row_size)};
    size_t next = 0;
    for (size_t i = 0; i < count; ++i) {
        if (prepared.reused.is_taken(i)) continue;
        TETRALIGHT_ASSERT(next < others.accumulators.size(), "one tally for each of the others");
        all.accumulators[i] = others.accumulators[next];
        std::ranges::copy(std::span(others.split_rows).subspan(next * row_size, row_size),
                          all.split_rows.begin() + static_cast<ptrdiff_t>(i * row_size));
        ++next;
    }
    return all;
}

}  // namespace tetralight
