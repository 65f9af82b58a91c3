// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/partial_bake.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <type_traits>

#include <tetralight/bake/round_plan.h>
#include <tetralight/base/contract.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/pipeline/split_light.h>
#include <tetralight/probes/is_finite.h>

namespace tetralight {
namespace {

/// Section "part".
struct PartInfo {
    uint64_t key = 0;
    uint32_t begin = 0;
    uint32_t end = 0;
    double target_error = 0.0;
    double time_budget_seconds = 0.0;
    uint64_t max_sample_count = 0;
    uint32_t sample_count = 0;
    uint32_t is_finished = 0;
    InvalidProbes invalid_probes = InvalidProbes::LeaveOut;
    DeringWindow dering_window = DeringWindow::Mildest;
    uint8_t dering_for_all_groups = 0;
    std::array<uint8_t, 5> reserved{};
};

static_assert(sizeof(PartInfo) == 56 && std::is_trivially_copyable_v<PartInfo>);

/// The elements of a section; none when it is not there.
template <class T>
std::vector<T> read_section(const ProbeFile& file, std::string_view name) {
    const auto bytes = file.section_bytes(name, sizeof(T));
    if (!bytes) return {};
    std::vector<T> elements(bytes->size() / sizeof(T));
    std::memcpy(elements.data(), bytes->data(), bytes->size());
    return elements;
}

/// Without what an unfinished bake should not have.
ProbeVolume unlit_volume(ProbeVolumeView view) {
    view.occlusion = {};
    view.validity = {};
    view.compact = {};
    view.layer_irradiance = {};
    view.transfer = {};
    view.dering = {};
    return copy_volume(view);
}

MergedProbes merged_probes(const ProbeVolume& volume, const std::vector<uint8_t>& dering) {
    MergedProbes merged;
    merged.positions = volume.exact_positions;
    for (const std::string_view name : split_names(volume.group_names)) {
        merged.group_names.emplace_back(name);
    }
    merged.sources = volume.sources;
    for (const uint8_t flag : dering) merged.group_dering.push_back(flag != 0);
    return merged;
}

BakeVolumeSettings settings_of(const PartInfo& info) {
    BakeVolumeSettings settings;
    settings.bake.sample_count = info.sample_count;
    settings.bake.target_error = info.target_error;
    settings.bake.time_budget_seconds = info.time_budget_seconds;
    settings.bake.max_sample_count = info.max_sample_count;
    settings.health.invalid = info.invalid_probes;
    settings.dering.window = info.dering_window;
    settings.dering.is_for_all_groups = info.dering_for_all_groups != 0;
    return settings;
}

/// Whether rounds of this plan can leave such a accumulator.
bool is_possible(const ProbeAccumulator& accumulator, const RoundPlan& plan) {
    for (const glm::dvec3& c : accumulator.radiance_sum) {
        if (!is_finite(c)) return false;
    }
    const uint64_t rounds = accumulator.round_count;
    return std::isfinite(accumulator.variance_sum) && accumulator.variance_sum >= 0.0 &&
           (rounds == 0 || plan.samples_in_round(rounds - 1) > 0) &&
           accumulator.sample_count == plan.samples_before(rounds) &&
           accumulator.back_face_count <= accumulator.sample_count;
}

Status check_tallies(const PartFile& part) {
    const RoundPlan plan(part.prepared.settings.bake);
    const auto& [range, accumulators, is_finished, split_rows] = part.partial;
    const size_t probe_count = part.prepared.volume.positions.size();
    if (range.begin > range.end || range.end > probe_count) {
        return Error{str_cat("probes ", range.begin, "..", range.end,
                             " are out of range (there are ", probe_count, ")")};
    }
    if (accumulators.size() != range.count()) {
        return Error{str_cat(accumulators.size(), " tallies for ", range.count(), " probes")};
    }
    const size_t row_size = split_layout(part.prepared.volume.view()).size();
    if (split_rows.size() != row_size * accumulators.size()) {
        return Error{str_cat("section \"split_rows\": ", split_rows.size(), " numbers for ",
                             accumulators.size(), " probes of ", row_size)};
    }
    for (size_t i = 0; i < split_rows.size(); ++i) {
        if (std::isfinite(split_rows[i])) continue;
        return Error{str_cat("what the light of probe ", range.begin + i / row_size,
                             " is split into is not finite")};
    }
    for (size_t i = 0; i < accumulators.size(); ++i) {
        const bool has_light = accumulators[i].round_count > 0 || !is_finished;
        if (has_light && is_possible(accumulators[i], plan)) continue;
        return Error{str_cat("the tally of probe ", range.begin + i, " is not in range")};
    }
    return Ok{};
}

Status check_overrides(const PreparedBake& prepared) {
    const auto& overrides = prepared.overrides;
    if (!overrides.empty() && overrides.size() != prepared.volume.positions.size()) {
        return Error{str_cat("section \"overrides\": ", overrides.size(), " of ",
                             prepared.volume.positions.size(), " probes")};
    }
    for (size_t i = 0; i < overrides.size(); ++i) {
        const auto& [intensity, validity] = overrides[i];
        const bool is_validity = validity == -1.0f || (validity >= 0.0f && validity <= 1.0f);
        if (intensity >= 0.0f && std::isfinite(intensity) && is_validity) continue;
        return Error{str_cat("section \"overrides\": that of probe ", i, " is not in range")};
    }
    return Ok{};
}

Result<PartFile> make_part(const std::string& path, const ProbeFile& file) {
    const auto infos = read_section<PartInfo>(file, "part");
    if (infos.size() != 1 || !file.view().irradiance.empty()) {
        return Error{
            "is no part of a bake (parts come from bake --probes, or from interrupted "
            "bakes)"};
    }
    const PartInfo& info = infos[0];
    PartFile part;
    part.path = path;
    part.partial.range = {info.begin, info.end};
    part.partial.accumulators = read_section<ProbeAccumulator>(file, "tallies");
    part.partial.split_rows = read_section<double>(file, "split_rows");
    part.partial.is_finished = info.is_finished != 0;
    part.prepared.key = info.key;
    part.prepared.settings = settings_of(info);
    if (info.invalid_probes > InvalidProbes::Keep || info.dering_window > DeringWindow::Lanczos) {
        return Error{"section \"part\": a setting is unknown"};
    }
    if (auto status = RoundPlan::check(part.prepared.settings.bake); !status) return status.error();
    part.prepared.volume = unlit_volume(file.view());
    const auto dering = read_section<uint8_t>(file, "group_dering");
    part.prepared.merged = merged_probes(part.prepared.volume, dering);
    if (dering.size() != part.prepared.merged.group_names.size()) {
        return Error{str_cat(dering.size(), " flags for ", part.prepared.merged.group_names.size(),
                             " groups")};
    }
    for (const uint8_t flag : read_section<uint8_t>(file, "is_invalid")) {
        part.prepared.is_invalid.push_back(flag != 0);
    }
    if (part.prepared.is_invalid.size() != part.prepared.volume.positions.size()) {
        return Error{str_cat("section \"is_invalid\": ", part.prepared.is_invalid.size(),
                             " flags for ", part.prepared.volume.positions.size(), " probes")};
    }
    part.prepared.overrides = read_section<ProbeOverride>(file, "overrides");
    if (auto status = check_overrides(part.prepared); !status) return status.error();
    if (part.prepared.volume.exact_positions.size() != part.prepared.volume.positions.size()) {
        return Error{"section \"exact_positions\" is missing"};
    }
    if (auto status = check_tallies(part); !status) return status.error();
    return part;
}

}  // namespace

size_t PartialBake::begun_count() const {
    return static_cast<size_t>(std::ranges::count_if(
        accumulators,
        [](const ProbeAccumulator& accumulator) { return accumulator.round_count > 0; }));
}

bool is_part(const ProbeFile& file) noexcept {
    return file.section_bytes("part", sizeof(PartInfo)).has_value();
}

Status write_part(const std::string& path, const PreparedBake& prepared,
                  const PartialBake& partial) {
    const auto& [range, accumulators, is_finished, split_rows] = partial;
    TETRALIGHT_ASSERT(accumulators.size() == range.count(),
                      "one tally for each probe of the range");
    const BakeSettings& settings = prepared.settings.bake;
    const PartInfo info{prepared.key,
                        range.begin,
                        range.end,
                        settings.target_error,
                        settings.time_budget_seconds,
                        settings.max_sample_count,
                        settings.sample_count,
                        is_finished,
                        prepared.settings.health.invalid,
                        prepared.settings.dering.window,
                        prepared.settings.dering.is_for_all_groups,
                        {}};
    const auto bytes_of = [](const std::vector<bool>& flags) {
        return std::vector<uint8_t>(flags.begin(), flags.end());
    };
    const std::vector<uint8_t> dering = bytes_of(prepared.merged.group_dering);
    const std::vector<uint8_t> invalid = bytes_of(prepared.is_invalid);
    std::vector<ExtraSection> sections{
        {"part", std::as_bytes(std::span(&info, 1)), sizeof info},
        {"group_dering", std::as_bytes(std::span(dering)), 1},
        {"is_invalid", std::as_bytes(std::span(invalid)), 1},
        {"tallies", std::as_bytes(std::span(accumulators)), sizeof(ProbeAccumulator)},
        {"split_rows", std::as_bytes(std::span(split_rows)), sizeof(double)},
    };
    if (!prepared.overrides.empty()) {
        sections.push_back(
            {"overrides", std::as_bytes(std::span(prepared.overrides)), sizeof(ProbeOverride)});
    }
    return write_probe_file(path, prepared.volume.view(), sections);
}

Result<PartFile> read_part(const std::string& path) {
    const auto file = open_probe_file(path);
    if (!file) return file.error();
    auto part = make_part(path, *file);
    if (!part) return part.error().in(path);
    return part;
}

}  // namespace tetralight
