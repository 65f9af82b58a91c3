// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/partial_bake.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

#include <tetralight/base/contract.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/pipeline/part_sections.h>
#include <tetralight/pipeline/split_light.h>
#include <tetralight/probes/section_error.h>

namespace tetralight {
namespace {

using detail::section_error;

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
        merged.group_empty_warnings.emplace_back();
    }
    merged.sources = volume.sources;
    for (const uint8_t flag : dering) merged.group_dering.push_back(flag != 0);
    return merged;
}

BakeVolumeSettings settings_of(const PartInfo& info) {
    BakeVolumeSettings settings;
    settings.bake = info.bake_settings();
    settings.health.invalid = info.invalid_probes;
    settings.dering.window = info.dering_window;
    settings.dering.is_for_all_groups = info.dering_for_all_groups != 0;
    return settings;
}

AllPlaces probes_of(const PartFile& part) {
    return {"probe", part.prepared.volume.positions.size()};
}

Status check_accumulators(const PartFile& part) {
    const auto& [range, accumulators, split_rows, reused] = part.partial;
    const size_t row_size = split_layout(part.prepared.volume.view()).size();
    const AllPlaces all = probes_of(part);
    return check_sums({range, accumulators, split_rows, row_size}, all, part.prepared.settings.bake,
                      reused.flags(all.count));
}

Status check_overrides(const PreparedBake& prepared) {
    const auto& overrides = prepared.overrides;
    if (!overrides.empty() && overrides.size() != prepared.volume.positions.size()) {
        return section_error("overrides", str_cat(overrides.size(), " elements for ",
                                                  prepared.volume.positions.size(), " probes"));
    }
    for (size_t i = 0; i < overrides.size(); ++i) {
        const auto& [intensity, validity] = overrides[i];
        const bool is_validity = validity == -1.0f || (validity >= 0.0f && validity <= 1.0f);
        if (intensity >= 0.0f && std::isfinite(intensity) && is_validity) continue;
        return section_error("overrides", str_cat("element of probe ", i, " is out of range"));
    }
    return Ok{};
}

/// Reads the light that the part reuses. Its probes have to be in the range, in order.
Status read_reused(const PartSections& sections, PartFile& part) {
    const auto& [begin, end] = part.partial.range;
    ReusedLight& reused = part.partial.reused;
    reused.probes = sections.read<uint32_t>("reused_probes");
    for (size_t i = 0; i < reused.probes.size(); ++i) {
        const uint32_t least = i == 0 ? begin : reused.probes[i - 1] + 1;
        if (reused.probes[i] >= least && reused.probes[i] < end) continue;
        return section_error("reused_probes", str_cat("element ", i, " is out of range"));
    }
    Status status = Ok{};
    const auto read = [&]<class T>(const char* name, std::vector<T>& values, size_t count) {
        values = sections.read<T>(name);
        std::vector<float> numbers(values.size() * sizeof(T) / sizeof(float));
        if (!numbers.empty()) std::memcpy(numbers.data(), values.data(), 4 * numbers.size());
        const auto is_sound = [](float number) { return std::isfinite(number); };
        if (values.size() != count * reused.probes.size()) {
            status = section_error(
                name, str_cat(values.size(), " elements for ", reused.probes.size(), " probes"));
        } else if (!std::ranges::all_of(numbers, is_sound)) {
            status = section_error(name, "a number is not finite");
        }
    };
    for_each_array(reused, part.prepared.volume, read);
    return status;
}

Result<PartFile> make_part(const std::string& path, const ProbeFile& file) {
    constexpr const char* kWriter = "bake --probes";
    const PartSections sections(file);
    const auto info = sections.info(kWriter);
    if (!info) return info.error();
    if (!file.view().irradiance.empty()) return not_a_part(kWriter);
    PartFile part;
    part.path = path;
    part.partial.range = info->range();
    part.partial.accumulators = sections.read<ProbeAccumulator>("tallies");
    part.partial.split_rows = sections.read<double>("split_rows");
    part.prepared.key = info->key;
    part.prepared.settings = settings_of(*info);
    if (info->invalid_probes > InvalidProbes::Keep || info->dering_window > DeringWindow::Lanczos) {
        return section_error("part", "a setting is unknown");
    }
    part.prepared.volume = unlit_volume(file.view());
    const auto dering = sections.read<uint8_t>("group_dering");
    part.prepared.merged = merged_probes(part.prepared.volume, dering);
    if (dering.size() != part.prepared.merged.group_names.size()) {
        return section_error("group_dering",
                             str_cat(dering.size(), " flags for ",
                                     part.prepared.merged.group_names.size(), " groups"));
    }
    for (const uint8_t flag : sections.read<uint8_t>("is_invalid")) {
        part.prepared.is_invalid.push_back(flag != 0);
    }
    if (part.prepared.is_invalid.size() != part.prepared.volume.positions.size()) {
        return section_error("is_invalid",
                             str_cat(part.prepared.is_invalid.size(), " flags for ",
                                     part.prepared.volume.positions.size(), " probes"));
    }
    part.prepared.overrides = sections.read<ProbeOverride>("overrides");
    if (auto status = check_overrides(part.prepared); !status) return status.error();
    if (part.prepared.volume.exact_positions.size() != part.prepared.volume.positions.size()) {
        return section_error("exact_positions", "is missing");
    }
    if (auto status = check_part_range(part.partial.range, probes_of(part)); !status) {
        return status.error();
    }
    if (auto status = read_reused(sections, part); !status) return status.error();
    if (auto status = check_accumulators(part); !status) return status.error();
    return part;
}

}  // namespace

bool is_part(const ProbeFile& file) noexcept {
    return PartSections(file).is_part();
}

Status write_part(const std::string& path, const PreparedBake& prepared,
                  const PartialBake& partial) {
    const auto& [range, accumulators, split_rows, reused] = partial;
    TETRALIGHT_ASSERT(accumulators.size() == range.count(),
                      "one accumulator for each probe of the range");
    const auto& [merge, bake, health, window, lighting] = prepared.settings;
    PartInfo info(prepared.key, range, bake);
    info.invalid_probes = health.invalid;
    info.dering_window = window.window;
    info.dering_for_all_groups = window.is_for_all_groups ? 1 : 0;
    const auto bytes_of = [](const std::vector<bool>& flags) {
        return std::vector<uint8_t>(flags.begin(), flags.end());
    };
    const std::vector<PartInfo> infos{info};
    const std::vector<uint8_t> dering = bytes_of(prepared.merged.group_dering);
    const std::vector<uint8_t> invalid = bytes_of(prepared.is_invalid);
    std::vector<ExtraSection> sections{
        section_of("part", infos), section_of("group_dering", dering),
        section_of("is_invalid", invalid), section_of("tallies", accumulators),
        section_of("split_rows", split_rows)};
    const auto add = [&]<class T>(const char* name, const std::vector<T>& values, size_t = 1) {
        sections.push_back(section_of(name, values));
    };
    add("overrides", prepared.overrides);
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
