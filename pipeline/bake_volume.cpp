// SPDX-License-Identifier: Apache-2.0
#include "pipeline/bake_volume.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "bake/bake_tallies.h"
#include "bake/memory_estimate.h"
#include "bake/project_environment.h"
#include "bake/round_plan.h"
#include "base/assert.h"
#include "base/text.h"
#include "pipeline/bake_key.h"
#include "probes/build/make_probe_volume.h"
#include "probes/build/merge_warnings.h"
#include "probes/compact_probes.h"

namespace tetralight {
namespace {

/// Seconds since the last call.
class Stopwatch {
  public:
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
    }

  private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// What is left at its default that changes no byte is left out.
std::string metadata(const BakeSettings& settings) {
    std::string json = text("{\"generator\":\"tetralight ", TETRALIGHT_VERSION,
                            "\",\"samples\":", settings.sample_count,
                            ",\"bounces\":", settings.bounces, ",\"seed\":", settings.seed);
    const auto add = [&](const char* name, auto value) {
        if (value != 0) json += text(",\"", name, "\":", value);
    };
    add("target_error", settings.target_error);
    add("max_samples", settings.max_sample_count);
    add("time_budget_seconds", settings.time_budget_seconds);
    add("clamp", settings.clamp);
    if (settings.surfaces != SurfaceSettings{}) {
        add("albedo_boost", settings.surfaces.albedo_boost);
        add("max_albedo", settings.surfaces.max_albedo);
    }
    return json + "}";
}

/// What every part of the volume is lit by, known before the bake.
void store_lights(const Scene& scene, const BakeSettings& settings, ProbeVolume& volume) {
    TETRALIGHT_ASSERT(scene.light_names.size() == scene.lights.size(), "one name for each light");
    volume.info.ambient =
        irradiance_from_radiance(project_environment(scene.environment, settings.thread_count));
    volume.lights = scene.lights;
    for (const std::string& name : scene.light_names) volume.light_names += name + "\n";
    volume.metadata = metadata(settings);
}

void store_light(const BakedProbes& baked, ProbeVolume& volume) {
    for (const RadianceSh& radiance : baked.radiance) {
        volume.irradiance.push_back(irradiance_from_radiance(radiance));
    }
    volume.validity = baked.validity;
    volume.health.resize(baked.radiance.size());
    for (size_t i = 0; i < volume.health.size(); ++i) {
        volume.health[i].standard_error = baked.standard_error[i];
    }
    make_compact_probes(volume);
}

/// Groups in which half of the probes or more lie inside something.
std::vector<std::string> buried_groups(const MergedProbes& merged,
                                       std::span<const float> validity) {
    std::vector<size_t> buried(merged.group_names.size(), 0);
    std::vector<size_t> total(merged.group_names.size(), 0);
    for (const ProbeSource& source : merged.sources) {
        ++total[source.group];
        buried[source.group] += validity[source.probe] < 0.5f;
    }
    std::vector<std::string> warnings;
    for (size_t g = 0; g < total.size(); ++g) {
        if (total[g] == 0 || 2 * buried[g] < total[g]) continue;
        warnings.push_back(text("group \"", merged.group_names[g], "\": ", buried[g], " of ",
                                total[g], " probes see mostly back faces (inside geometry?)"));
    }
    return warnings;
}

/// Probes that no light reaches, as in hollow walls.
void add_dark_warning(std::span<const RadianceSh> radiance, uint32_t sample_count,
                      std::vector<std::string>& warnings) {
    constexpr uint32_t kEnoughSamples = 64;  // with fewer a probe may miss a small opening
    const auto dark = std::ranges::count_if(
        radiance, [](const RadianceSh& sh) { return sh.coefficients[0] == glm::vec3(0.0f); });
    const bool is_all = dark == std::ssize(radiance);  // a scene without light: nothing is odd
    if (dark == 0 || is_all || sample_count < kEnoughSamples) return;
    warnings.push_back(text(dark, " of ", radiance.size(),
                            " probes receive no light at all (in closed hollows?); what they light "
                            "will be black"));
}

/// Probes that took all samples that they may, or all the time, and have not the error asked for.
void add_target_warning(const BakeStatistics& statistics, double target_error, size_t probe_count,
                        std::vector<std::string>& warnings) {
    if (statistics.over_target_count == 0) return;
    warnings.push_back(text(statistics.over_target_count, " of ", probe_count,
                            " probes have a standard error above ", target_error, " (the worst ",
                            statistics.worst_error, ") with the samples and the time they had"));
}

void add_dering_warnings(const MergedProbes& merged, std::vector<std::string>& warnings) {
    for (size_t g = 0; g < merged.group_names.size(); ++g) {
        if (!merged.group_dering[g]) continue;
        warnings.push_back(text("group \"", merged.group_names[g],
                                "\": dering is asked for, which this version does not do"));
    }
}

}  // namespace

Result<PreparedBake> prepare_bake(const Scene& scene, std::span<const ProbeGroup> groups,
                                  const MergeSettings& merge_settings,
                                  const BakeSettings& settings) {
    if (auto status = RoundPlan::check(settings); !status) return status.error();
    size_t position_count = 0;
    for (const ProbeGroup& group : groups) position_count += group.positions.size();
    if (auto status = check_bake_memory(scene, position_count); !status) return status.error();
    PreparedBake prepared;
    prepared.settings = settings;
    Stopwatch watch;
    auto merged = merge(groups, merge_settings);
    if (!merged) return merged.error();
    prepared.merged = std::move(*merged);
    prepared.report.welded_count = prepared.merged.welded_count();
    prepared.report.lattice_group_names = prepared.merged.lattice_group_names();
    prepared.report.largest_snap = prepared.merged.largest_snap;
    prepared.report.merge_seconds = watch.lap();

    prepared.volume = make_probe_volume(prepared.merged);
    prepared.report.tetrahedralize_seconds = watch.lap();

    prepared.capture_positions = prepared.merged.positions;
    store_lights(scene, settings, prepared.volume);
    prepared.key = bake_key(scene, prepared);
    return prepared;
}

BakedVolume finish_bake(PreparedBake prepared, std::span<const ProbeTally> tallies) {
    TETRALIGHT_ASSERT(tallies.size() == prepared.volume.positions.size(), "one for each probe");
    const BakedProbes baked = baked_probes(tallies);
    store_light(baked, prepared.volume);

    const BakeSettings& settings = prepared.settings;
    BakeReport& report = prepared.report;
    report.ray_count = baked.ray_count;
    report.statistics = bake_statistics(baked, settings.target_error);
    report.warnings = merge_warnings(prepared.merged, prepared.volume.info.dimension);
    for (std::string& warning : buried_groups(prepared.merged, prepared.volume.validity)) {
        report.warnings.push_back(std::move(warning));
    }
    add_dark_warning(baked.radiance, settings.sample_count, report.warnings);
    add_target_warning(report.statistics, settings.target_error, tallies.size(), report.warnings);
    add_dering_warnings(prepared.merged, report.warnings);
    return {std::move(prepared.volume), std::move(prepared.report)};
}

Result<BakedVolume> bake_volume(const Scene& scene, std::span<const ProbeGroup> groups,
                                const MergeSettings& merge_settings, const BakeSettings& settings,
                                const BakeCallback& callback) {
    auto prepared = prepare_bake(scene, groups, merge_settings, settings);
    if (!prepared) return prepared.error();
    Stopwatch watch;
    std::vector<ProbeTally> tallies(prepared->capture_positions.size());
    const auto status =
        bake_tallies(scene, prepared->capture_positions, settings, tallies, {.progress = callback});
    if (!status) return status.error();
    BakedVolume baked = finish_bake(std::move(*prepared), tallies);
    baked.report.bake_seconds = watch.lap();
    return baked;
}

}  // namespace tetralight
