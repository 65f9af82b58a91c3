// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/partial_bake.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <utility>

#include <tetralight/base/contract.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/pipeline/bake_key.h>
#include <tetralight/pipeline/bake_metadata.h>
#include <tetralight/pipeline/lighting_plan.h>
#include <tetralight/pipeline/part_sections.h>
#include <tetralight/pipeline/split_light.h>
#include <tetralight/probes/section_error.h>
#include <tetralight/probes/volume_members.h>

namespace tetralight {
namespace {

using detail::section_error;

constexpr const char* kWriter = "bake --probes";

/// A copy without the arrays that the end of a bake fills. Most memory of a bake is here: no more
/// than one array is in memory twice.
ProbeVolume unlit_volume(const ProbeFile& file) {
    ProbeVolumeView view = file.view();
    view.occlusion = {};
    view.validity = {};
    view.compact = {};
    view.layer_irradiance = {};
    view.layer_errors = {};
    view.transfer = {};
    view.dering = {};
    file.release_pages();
    ProbeVolume volume;
    volume.info = view.info;
    for_each_volume_member([&](const char*, MemberUse, auto owner, auto viewed) {
        (volume.*owner).assign((view.*viewed).begin(), (view.*viewed).end());
        file.release_pages();
    });
    return volume;
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

AllPlaces probes_of(const PreparedBake& prepared) {
    return {"probe", prepared.volume.positions.size()};
}

Status check_accumulators(const PartialBake& partial, const PreparedBake& prepared) {
    const auto& [range, accumulators, split_rows, reused] = partial;
    const size_t row_size = split_layout(prepared.volume.view()).size();
    const AllPlaces all = probes_of(prepared);
    return check_sums({range, accumulators, split_rows, row_size}, all, prepared.settings.bake,
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
Status read_reused(const PartSections& sections, const PreparedBake& prepared,
                   PartialBake& partial) {
    ReusedLight& reused = partial.reused;
    reused.probes = sections.read<uint32_t>("reused_probes");
    for (size_t i = 0; i < reused.probes.size(); ++i) {
        const bool is_in_order = i == 0 || reused.probes[i - 1] < reused.probes[i];
        if (is_in_order && partial.range.contains(reused.probes[i])) continue;
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
    for_each_array(reused, prepared.volume, read);
    return status;
}

/// The light of a part, verified.
Result<PartialBake> read_light(const PartSections& sections, const PlaceRange& range,
                               const PreparedBake& prepared) {
    PartialBake partial{range, sections.read<ProbeAccumulator>("tallies"),
                        sections.read<double>("split_rows")};
    if (auto status = check_part_range(range, probes_of(prepared)); !status) return status.error();
    if (auto status = read_reused(sections, prepared, partial); !status) return status.error();
    if (auto status = check_accumulators(partial, prepared); !status) return status.error();
    return partial;
}

/// True if a part has no cells.
bool is_light_alone(const ProbeFile& file, const PartInfo& info) {
    return file.view().positions.empty() && info.range().count() > 0;
}

Result<PartFile> make_part(const std::string& path, const ProbeFile& file) {
    const PartSections sections(file);
    const auto info = sections.info(kWriter);
    if (!info) return info.error();
    if (!file.view().irradiance.empty()) return not_a_part(kWriter);
    if (is_light_alone(file, *info)) {
        return Error{ErrorCode::InvalidArgument,
                     "is the light of a part without its cells; name the prepared bake too "
                     "(--prepared)"};
    }
    PartFile part;
    part.path = path;
    part.prepared.key = info->key;
    part.prepared.settings = settings_of(*info);
    if (info->invalid_probes > InvalidProbes::Keep || info->dering_window > DeringWindow::Lanczos) {
        return section_error("part", "a setting is unknown");
    }
    part.prepared.volume = unlit_volume(file);
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
    part.prepared.capture_positions = sections.read<glm::dvec3>("capture_positions");
    auto light = read_light(sections, info->range(), part.prepared);
    if (!light) return light.error();
    part.partial = std::move(*light);
    return part;
}

/// Returns invalid_argument if a part is not the light of a range of this bake.
Result<PartInfo> light_part_info(const ProbeFile& file, const PreparedBake& prepared) {
    const auto info = PartSections(file).info(kWriter);
    if (!info) return info.error();
    if (!file.view().positions.empty()) {
        return Error{ErrorCode::InvalidArgument,
                     "is a part with cells of its own; merge such parts without --prepared"};
    }
    if (info->key != prepared.key) {
        return Error{ErrorCode::InvalidArgument,
                     "is of another bake than the prepared one (scene, groups, settings or program "
                     "version differ)"};
    }
    return info;
}

std::vector<uint8_t> bytes_of(const std::vector<bool>& flags) {
    return {flags.begin(), flags.end()};
}

PartInfo part_info(const PreparedBake& prepared, const PlaceRange& range) {
    const auto& [merge, bake, health, window, lighting] = prepared.settings;
    PartInfo info(prepared.key, range, bake);
    info.invalid_probes = health.invalid;
    info.dering_window = window.window;
    info.dering_for_all_groups = window.is_for_all_groups ? 1 : 0;
    return info;
}

/// The sections of a part's light. The values outlive it.
std::vector<ExtraSection> light_sections(const std::vector<PartInfo>& infos,
                                         const PreparedBake& prepared, const PartialBake& partial) {
    const auto& [range, accumulators, split_rows, reused] = partial;
    TETRALIGHT_ASSERT(accumulators.size() == range.count(),
                      "one accumulator for each probe of the range");
    std::vector<ExtraSection> sections{section_of("part", infos),
                                       section_of("tallies", accumulators),
                                       section_of("split_rows", split_rows)};
    const auto add = [&]<class T>(const char* name, const std::vector<T>& values, size_t = 1) {
        sections.push_back(section_of(name, values));
    };
    add("reused_probes", reused.probes);
    for_each_array(reused, prepared.volume, add);
    return sections;
}

/// `capture_positions`: of a prepared bake, else empty.
Status write_with_cells(const std::string& path, const PreparedBake& prepared,
                        const PartialBake& partial,
                        const std::vector<glm::dvec3>& capture_positions) {
    const std::vector<PartInfo> infos{part_info(prepared, partial.range)};
    const std::vector<uint8_t> dering = bytes_of(prepared.merged.group_dering);
    const std::vector<uint8_t> invalid = bytes_of(prepared.is_invalid);
    auto sections = light_sections(infos, prepared, partial);
    sections.push_back(section_of("group_dering", dering));
    sections.push_back(section_of("is_invalid", invalid));
    sections.push_back(section_of("overrides", prepared.overrides));
    if (!capture_positions.empty())
        sections.push_back(section_of("capture_positions", capture_positions));
    return write_probe_file(path, prepared.volume.view(), sections);
}

Result<PreparedBake> prepared_in(PartFile part) {
    PreparedBake& prepared = part.prepared;
    if (part.partial.range.count() > 0 ||
        prepared.capture_positions.size() != prepared.volume.positions.size()) {
        return Error{ErrorCode::InvalidArgument, "is not a prepared bake (plan writes them)"};
    }
    for (size_t i = 0; i < prepared.capture_positions.size(); ++i) {
        const glm::dvec3& position = prepared.capture_positions[i];
        if (std::isfinite(position.x + position.y + position.z)) continue;
        return section_error("capture_positions", str_cat("element ", i, " is not finite"));
    }
    return std::move(prepared);
}

}  // namespace

bool is_part(const ProbeFile& file) noexcept {
    return PartSections(file).is_part();
}

Status write_part(const std::string& path, const PreparedBake& prepared,
                  const PartialBake& partial) {
    return write_with_cells(path, prepared, partial, {});
}

Result<PartFile> read_part(const std::string& path) {
    const auto file = open_probe_file(path);
    if (!file) return file.error();
    auto part = make_part(path, *file);
    if (!part) return part.error().in(path);
    return part;
}

Status write_prepared_bake(const std::string& path, const PreparedBake& prepared) {
    return write_with_cells(path, prepared, {}, prepared.capture_positions);
}

Result<PreparedBake> read_prepared_bake(const std::string& path) {
    auto part = read_part(path);
    if (!part) return part.error();
    auto prepared = prepared_in(std::move(*part));
    if (!prepared) return prepared.error().in(path);
    return prepared;
}

Result<PreparedBake> read_prepared_bake(const std::string& path, const Scene& scene,
                                        const BakeVolumeSettings& settings) {
    auto prepared = read_prepared_bake(path);
    if (!prepared) return prepared;
    const auto other = [&path](const char* what) {
        return Error{ErrorCode::InvalidArgument,
                     str_cat(path, ": is prepared for ", what, "; plan the bake again")};
    };
    if (is_of_another_scene(prepared->volume.metadata, scene)) return other("another scene");
    const auto plan = plan_lighting(scene, settings.lighting);
    if (!plan) return plan.error();
    prepared->settings = settings;
    prepared->settings.bake.plan = plan->bake;
    if (bake_key(*prepared) != prepared->key) return other("other settings or program version");
    return prepared;
}

Status write_light_part(const std::string& path, const PreparedBake& prepared,
                        const PartialBake& partial) {
    const std::vector<PartInfo> infos{part_info(prepared, partial.range)};
    return write_probe_file(path, ProbeVolumeView{}, light_sections(infos, prepared, partial));
}

Result<PlaceRange> light_part_range(const std::string& path, const PreparedBake& prepared) {
    const auto file = open_probe_file_lazy(path);
    if (!file) return file.error();
    const auto info = light_part_info(*file, prepared);
    if (!info) return info.error().in(path);
    const PlaceRange range = info->range();
    if (auto status = check_part_range(range, probes_of(prepared)); !status)
        return status.error().in(path);
    return range;
}

Result<PartialBake> read_light_part(const std::string& path, const PreparedBake& prepared) {
    const auto file = open_probe_file(path);
    if (!file) return file.error();
    const auto info = light_part_info(*file, prepared);
    if (!info) return info.error().in(path);
    auto light = read_light(PartSections(*file), info->range(), prepared);
    if (!light) return light.error().in(path);
    return light;
}

}  // namespace tetralight
