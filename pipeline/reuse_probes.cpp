// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/reuse_probes.h>

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

#include <tetralight/base/str_cat.h>
#include <tetralight/pipeline/scene_choice_record.h>

namespace tetralight {
namespace {

using Json = nlohmann::json;
using PositionBits = std::array<uint64_t, 3>;

PositionBits bits_of(const glm::dvec3& position) {
    return {std::bit_cast<uint64_t>(position.x), std::bit_cast<uint64_t>(position.y),
            std::bit_cast<uint64_t>(position.z)};
}

/// Checks that the volume has the arrays of a baked volume.
Status check_arrays(const ProbeVolumeView& old) {
    const size_t count = old.positions.size();
    const auto is_missing = [&](const auto& array, bool is_needed = true) {
        return is_needed && array.size() < count;
    };
    if (is_missing(old.irradiance)) return Error{ErrorCode::InvalidArgument, "it has no light"};
    if (is_missing(old.validity) || is_missing(old.health) || is_missing(old.exact_positions) ||
        is_missing(old.occlusion, !old.occlusion_lights.empty()) ||
        is_missing(old.layer_irradiance, !old.layers.empty()) ||
        is_missing(old.layer_errors, !old.layers.empty()) ||
        is_missing(old.transfer, !old.sky.empty())) {
        return Error{ErrorCode::InvalidArgument, "a section is missing"};
    }
    return Ok{};
}

std::string difference_text(const std::string& member, const Json& old, const Json& fresh) {
    if (member == "scene") return "its scene, sky or sun is different";
    if (member == "adjustments") return "its adjustment volumes are different";
    if (member == "generator")
        return str_cat("it was made by ", old.dump(), ", not by ", fresh.dump());
    if (member == "relit") return str_cat("it was relit with ", old.dump());
    const auto value = [](const Json& json) {
        return json.is_null() ? std::string("not set") : json.dump();
    };
    return str_cat("its setting ", member, " is ", value(old), ", that of this bake is ",
                   value(fresh));
}

Error difference(const std::string& member, const Json& old, const Json& fresh) {
    return {ErrorCode::InvalidArgument, member, old.is_null() ? "" : old.dump(),
            difference_text(member, old, fresh)};
}

/// Compares how both volumes were baked. Dering is compared for each probe instead, and what was
/// found of walls is a result, not a setting.
Status check_metadata(std::string_view old, std::string_view fresh) {
    Json old_json = Json::parse(old, nullptr, false);
    Json fresh_json = Json::parse(fresh, nullptr, false);
    if (!old_json.is_object() || !old_json.contains("scene")) {
        return Error{ErrorCode::InvalidArgument, "scene", "",
                     "its metadata has no hash of its scene"};
    }
    for (const char* member : {"dering", "walls"}) {
        old_json.erase(member);
        fresh_json.erase(member);
    }
    for (const char* member : kSceneChoiceMembers) {
        old_json.erase(member);
        fresh_json.erase(member);
    }
    if (old_json == fresh_json) return Ok{};
    Json all = fresh_json;
    all.update(old_json);
    for (const char* first : {"generator", "scene", "adjustments", "relit"}) {
        const Json a = old_json.value(first, Json()), b = fresh_json.value(first, Json());
        if (a != b) return difference(first, a, b);
    }
    for (const auto& [member, ignored] : all.items()) {
        const Json a = old_json.value(member, Json()), b = fresh_json.value(member, Json());
        if (a != b) return difference(member, a, b);
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
    if (auto status = check_metadata(old.metadata, fresh.metadata); !status) return status;
    if (listed(old) == listed(fresh)) return Ok{};
    return Error{ErrorCode::InvalidArgument, "layers", listed(old),
                 str_cat("its layers are ", listed(old), ", those of this bake ", listed(fresh))};
}

/// One a probe: true if it, or a probe in a cell with it, is dilated.
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

/// World position that the light of a probe was sampled at.
glm::dvec3 capture_position(const ProbeVolumeView& volume, uint32_t probe) {
    return volume.exact_positions[probe] + glm::dvec3(volume.health[probe].virtual_offset);
}

/// One a probe: the index in `old` of the same probe with the same light, or kNoIndex.
std::vector<uint32_t> find_same_probes(const ProbeVolumeView& old, const PreparedBake& prepared) {
    std::map<PositionBits, uint32_t> old_at;
    for (uint32_t i = 0; i < old.probe_count(); ++i) old_at[bits_of(old.exact_positions[i])] = i;
    const std::vector<bool> is_near_dilated = near_dilated(prepared);
    const std::vector<uint8_t> dering = dering_marks(prepared.merged, prepared.settings.dering);
    std::vector<uint32_t> same(prepared.capture_positions.size(), kNoIndex);
    for (size_t i = 0; i < same.size(); ++i) {
        const auto found = old_at.find(bits_of(prepared.merged.positions[i]));
        if (found == old_at.end() || is_near_dilated[i]) continue;
        const uint32_t probe = found->second;
        const uint8_t old_dering = old.dering.empty() ? uint8_t{0} : old.dering[probe];
        const bool is_same =
            old.health[probe].is_dilated == 0 && old_dering == dering[i] &&
            bits_of(capture_position(old, probe)) == bits_of(prepared.capture_positions[i]);
        if (is_same) same[i] = probe;
    }
    return same;
}

}  // namespace

Status reuse_probes(const ProbeVolumeView& old, PreparedBake& prepared) {
    if (auto status = check_same_bake(old, prepared.volume.view()); !status) return status;
    prepared.reused = reused_light(old, find_same_probes(old, prepared));
    return Ok{};
}

}  // namespace tetralight
