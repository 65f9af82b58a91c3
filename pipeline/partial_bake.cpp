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
#include <tetralight/pipeline/check_accumulator.h>
#include <tetralight/pipeline/split_light.h>

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
    uint32_t is_finished = 1;  ///< earlier versions wrote unfinished parts
    InvalidProbes invalid_probes = InvalidProbes::LeaveOut;
    DeringWindow dering_window = DeringWindow::Mildest;
    uint8_t dering_for_all_groups = 0;
    uint8_t reserved = 0;
    float target_layer_error = 0.0f;
};

static_assert(sizeof(PartInfo) == 56 && std::is_trivially_copyable_v<PartInfo>);

Error corrupt(const std::string& section, const std::string& problem) {
    return Error{ErrorCode::Corrupt, section, "", str_cat("section \"", section, "\": ", problem)};
}

/// The elements of a section; empty if the file does not have it.
template <class T>
std::vector<T> read_section(const ProbeFile& file, std::string_view name) {
    const auto bytes = file.section_bytes(name, sizeof(T));
    if (!bytes) return {};
    std::vector<T> elements(bytes->size() / sizeof(T));
    std::memcpy(elements.data(), bytes->data(), bytes->size());
    return elements;
}

/// Returns unsupported if the accumulators are of an earlier or later version of the program.
Status check_version(const ProbeFile& file) {
    for (const ProbeFile::Section& section : file.sections()) {
        if (section.name != "tallies" || section.element_size == sizeof(ProbeAccumulator)) continue;
        return Error{ErrorCode::Unsupported, section.name, str_cat(section.element_size),
                     str_cat("another version of the program wrote this part (its elements have ",
                             section.element_size, " bytes instead of ", sizeof(ProbeAccumulator),
                             "); bake it again")};
    }
    return Ok{};
}

/// A copy without the arrays that the end of a bake fills.
ProbeVolume unlit_volume(ProbeVolumeView view) {
    view.occlusion = {};
    view.validity = {};
    view.compact = {};
    view.layer_irradiance = {};
    view.layer_errors = {};
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
    settings.bake.target_layer_error = static_cast<double>(info.target_layer_error);
    settings.bake.time_budget_seconds = info.time_budget_seconds;
    settings.bake.max_sample_count = info.max_sample_count;
    settings.health.invalid = info.invalid_probes;
    settings.dering.window = info.dering_window;
    settings.dering.is_for_all_groups = info.dering_for_all_groups != 0;
    return settings;
}

Status check_range(const PartFile& part) {
    const auto& [begin, end] = part.partial.range;
    const size_t probe_count = part.prepared.volume.positions.size();
    if (begin <= end && end <= probe_count) return Ok{};
    return Error{ErrorCode::Corrupt, str_cat("probes ", begin, "..", end,
                                             " are out of range (there are ", probe_count, ")")};
}

Status check_accumulators(const PartFile& part) {
    const RoundPlan plan(part.prepared.settings.bake);
    const auto& [range, accumulators, split_rows, reused] = part.partial;
    const size_t probe_count = part.prepared.volume.positions.size();
    if (accumulators.size() != range.count()) {
        return corrupt("tallies",
                       str_cat(accumulators.size(), " elements for ", range.count(), " probes"));
    }
    const size_t row_size = split_layout(part.prepared.volume.view()).size();
    if (split_rows.size() != row_size * accumulators.size()) {
        return corrupt("split_rows", str_cat(split_rows.size(), " numbers for ",
                                             accumulators.size(), " probes of ", row_size));
    }
    for (size_t i = 0; i < split_rows.size(); ++i) {
        if (std::isfinite(split_rows[i])) continue;
        return corrupt("split_rows",
                       str_cat("row of probe ", range.begin + i / row_size, " is not finite"));
    }
    const auto is_reused = reused.flags(probe_count);
    for (size_t i = 0; i < accumulators.size(); ++i) {
        const bool has_light = (accumulators[i].round_count > 0) != is_reused[range.begin + i];
        if (has_light && is_possible(accumulators[i], plan)) continue;
        return corrupt("tallies",
                       str_cat("element of probe ", range.begin + i, " is out of range"));
    }
    return Ok{};
}

Status check_overrides(const PreparedBake& prepared) {
    const auto& overrides = prepared.overrides;
    if (!overrides.empty() && overrides.size() != prepared.volume.positions.size()) {
        return corrupt("overrides", str_cat(overrides.size(), " elements for ",
                                            prepared.volume.positions.size(), " probes"));
    }
    for (size_t i = 0; i < overrides.size(); ++i) {
        const auto& [intensity, validity] = overrides[i];
        const bool is_validity = validity == -1.0f || (validity >= 0.0f && validity <= 1.0f);
        if (intensity >= 0.0f && std::isfinite(intensity) && is_validity) continue;
        return corrupt("overrides", str_cat("element of probe ", i, " is out of range"));
    }
    return Ok{};
}

/// Reads the light that the part reuses. Its probes have to be in the range, in order.
Status read_reused(const ProbeFile& file, PartFile& part) {
    const auto& [begin, end] = part.partial.range;
    ReusedLight& reused = part.partial.reused;
    reused.probes = read_section<uint32_t>(file, "reused_probes");
    for (size_t i = 0; i < reused.probes.size(); ++i) {
        const uint32_t least = i == 0 ? begin : reused.probes[i - 1] + 1;
        if (reused.probes[i] >= least && reused.probes[i] < end) continue;
        return corrupt("reused_probes", str_cat("element ", i, " is out of range"));
    }
    Status status = Ok{};
    const auto read = [&]<class T>(const char* name, std::vector<T>& values, size_t count) {
        values = read_section<T>(file, name);
        std::vector<float> numbers(values.size() * sizeof(T) / sizeof(float));
        if (!numbers.empty()) std::memcpy(numbers.data(), values.data(), 4 * numbers.size());
        const auto is_sound = [](float number) { return std::isfinite(number); };
        if (values.size() != count * reused.probes.size()) {
            status = corrupt(
                name, str_cat(values.size(), " elements for ", reused.probes.size(), " probes"));
        } else if (!std::ranges::all_of(numbers, is_sound)) {
            status = corrupt(name, "a number is not finite");
        }
    };
    for_each_array(reused, part.prepared.volume, read);
    return status;
}

Result<PartFile> make_part(const std::string& path, const ProbeFile& file) {
    const auto infos = read_section<PartInfo>(file, "part");
    if (infos.size() != 1 || !file.view().irradiance.empty()) {
        return Error{ErrorCode::InvalidArgument,
                     "is not a part of a bake (bake --probes writes parts)"};
    }
    const PartInfo& info = infos[0];
    if (auto status = check_version(file); !status) return status.error();
    if (info.is_finished == 0) return Error{ErrorCode::InvalidArgument, "is not finished"};
    PartFile part;
    part.path = path;
    part.partial.range = {info.begin, info.end};
    part.partial.accumulators = read_section<ProbeAccumulator>(file, "tallies");
    part.partial.split_rows = read_section<double>(file, "split_rows");
    part.prepared.key = info.key;
    part.prepared.settings = settings_of(info);
    if (info.invalid_probes > InvalidProbes::Keep || info.dering_window > DeringWindow::Lanczos) {
        return corrupt("part", "a setting is unknown");
    }
    if (auto status = RoundPlan::check(part.prepared.settings.bake); !status) return status.error();
    part.prepared.volume = unlit_volume(file.view());
    const auto dering = read_section<uint8_t>(file, "group_dering");
    part.prepared.merged = merged_probes(part.prepared.volume, dering);
    if (dering.size() != part.prepared.merged.group_names.size()) {
        return corrupt("group_dering", str_cat(dering.size(), " flags for ",
                                               part.prepared.merged.group_names.size(), " groups"));
    }
    for (const uint8_t flag : read_section<uint8_t>(file, "is_invalid")) {
        part.prepared.is_invalid.push_back(flag != 0);
    }
    if (part.prepared.is_invalid.size() != part.prepared.volume.positions.size()) {
        return corrupt("is_invalid", str_cat(part.prepared.is_invalid.size(), " flags for ",
                                             part.prepared.volume.positions.size(), " probes"));
    }
    part.prepared.overrides = read_section<ProbeOverride>(file, "overrides");
    if (auto status = check_overrides(part.prepared); !status) return status.error();
    if (part.prepared.volume.exact_positions.size() != part.prepared.volume.positions.size()) {
        return corrupt("exact_positions", "is missing");
    }
    if (auto status = check_range(part); !status) return status.error();
    if (auto status = read_reused(file, part); !status) return status.error();
    if (auto status = check_accumulators(part); !status) return status.error();
    return part;
}

}  // namespace

bool is_part(const ProbeFile& file) noexcept {
    return file.section_bytes("part", sizeof(PartInfo)).has_value();
}

Status write_part(const std::string& path, const PreparedBake& prepared,
                  const PartialBake& partial) {
    const auto& [range, accumulators, split_rows, reused] = partial;
    TETRALIGHT_ASSERT(accumulators.size() == range.count(),
                      "one accumulator for each probe of the range");
    const BakeSettings& settings = prepared.settings.bake;
    const PartInfo info{prepared.key,
                        range.begin,
                        range.end,
                        settings.target_error,
                        settings.time_budget_seconds,
                        settings.max_sample_count,
                        settings.sample_count,
                        1,
                        prepared.settings.health.invalid,
                        prepared.settings.dering.window,
                        prepared.settings.dering.is_for_all_groups,
                        0,
                        static_cast<float>(settings.target_layer_error)};
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
    const auto add = [&]<class T>(const char* name, const std::vector<T>& values, size_t = 1) {
        if (!values.empty())
            sections.push_back({name, std::as_bytes(std::span(values)), sizeof(T)});
    };
    add("reused_probes", reused.probes);
    for_each_array(reused, prepared.volume, add);
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
