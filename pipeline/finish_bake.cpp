// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/finish_bake.h>

#include <algorithm>
#include <utility>
#include <vector>

#include <tetralight/base/contract.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/pipeline/dilate_probes.h>
#include <tetralight/pipeline/probe_warnings.h>
#include <tetralight/pipeline/split_light.h>
#include <tetralight/probes/build/merge_warnings.h>
#include <tetralight/probes/compact_probes.h>

namespace tetralight {
namespace {

/// Warns of probes whose standard error is above the target after all samples or all the time.
void add_target_warning(const BakeStatistics& statistics, double target_error, size_t probe_count,
                        std::vector<std::string>& warnings) {
    if (statistics.over_target_count == 0) return;
    warnings.push_back(str_cat(statistics.over_target_count, " of ", probe_count,
                               " probes have a standard error above ", target_error, " (the worst ",
                               statistics.worst_error, ") with the samples and the time they had"));
}

void remove_ringing(const MergedProbes& merged, const DeringSettings& settings,
                    ProbeVolume& volume) {
    if (volume.layers.empty()) {
        dering_probes(merged, settings, volume.irradiance);
    } else {
        dering_layers(dering_asked_for(merged, settings), settings.window, volume);
    }
    auto marks = dering_marks(merged, settings);
    const bool is_any = std::ranges::any_of(marks, [](uint8_t mark) { return mark != 0; });
    if (is_any || !volume.transfer.empty()) volume.dering = std::move(marks);
}

/// Changes baked light as settings and adjustment volumes ask.
void finish_light(const PreparedBake& prepared, ProbeVolume& volume, BakeReport& report) {
    const BakeVolumeSettings& settings = prepared.settings;
    if (settings.health.invalid == InvalidProbes::Dilate) {
        report.dilated_count = dilate_probes(prepared.is_invalid, volume);
    }
    store_rest(volume);
    add_dark_warnings(prepared.merged, volume.irradiance, settings.bake.sample_count,
                      report.warnings);
    override_probes(prepared.overrides, volume);
    remove_ringing(prepared.merged, settings.dering, volume);
    copy_reused(prepared.reused, volume);
}

}  // namespace

BakeFinisher::BakeFinisher(PreparedBake prepared) : prepared_(std::move(prepared)) {
    const size_t count = prepared_.volume.positions.size();
    prepared_.capture_positions = std::vector<glm::dvec3>();  // of the bake alone, and large
    prepared_.volume.irradiance.resize(count);
    prepared_.volume.validity.resize(count);
    light_.standard_error.resize(count);
    light_.sampling_error.resize(count);
    light_.sample_count.resize(count);
}

void BakeFinisher::add(const PlaceRange& range, std::span<const ProbeAccumulator> accumulators,
                       std::span<const double> split_rows) {
    ProbeVolume& volume = prepared_.volume;
    TETRALIGHT_ASSERT(range.end <= volume.positions.size(), "probes of the bake");
    const BakedProbes baked = make_baked_probes(accumulators);
    const auto add_all = [&range](const auto& values, auto& all) {
        put(std::span(values), range, std::span(all));
    };
    for (size_t i = 0; i < accumulators.size(); ++i)
        volume.irradiance[range[i]] = irradiance_from_radiance(baked.radiance[i]);
    add_all(baked.validity, volume.validity);
    add_all(baked.standard_error, light_.standard_error);
    add_all(baked.sampling_error, light_.sampling_error);
    add_all(baked.sample_count, light_.sample_count);
    light_.ray_count += baked.ray_count;
    store_split(range, accumulators, split_rows, volume);
    added_count_ += accumulators.size();
}

void BakeFinisher::add(const PartialBake& partial) {
    add(partial.range, partial.accumulators, partial.split_rows);
    prepared_.reused.append(partial.reused);
}

BakedVolume BakeFinisher::finish() && {
    const size_t count = prepared_.volume.positions.size();
    TETRALIGHT_ASSERT(added_count_ == count, "each probe was added once");
    copy_reused(prepared_.reused, light_);
    ProbeVolume volume = std::move(prepared_.volume);
    BakeReport report = std::move(prepared_.report);
    for (size_t i = 0; i < volume.health.size(); ++i)
        volume.health[i].standard_error = light_.standard_error[i];
    copy_reused(prepared_.reused, volume);

    const double target_error = prepared_.settings.bake.target_error;
    report.ray_count = light_.ray_count;
    report.reused_count = prepared_.reused.probes.size();
    report.statistics = bake_statistics(light_, target_error);
    const auto merge_lines = merge_warnings(prepared_.merged, volume.info.dimension);
    report.warnings.insert(report.warnings.begin(), merge_lines.begin(), merge_lines.end());
    add_target_warning(report.statistics, target_error, count, report.warnings);
    finish_light(prepared_, volume, report);
    prepared_ = PreparedBake();  // compact probes need memory of their own
    light_ = BakedProbes();
    make_compact_probes(volume);
    sum_layers(volume);
    return {std::move(volume), std::move(report)};
}

BakedVolume finish_bake(PreparedBake prepared, std::span<const ProbeAccumulator> accumulators,
                        std::span<const double> split_rows) {
    BakeFinisher bake(std::move(prepared));
    bake.add({0, static_cast<uint32_t>(accumulators.size())}, accumulators, split_rows);
    return std::move(bake).finish();
}

}  // namespace tetralight
