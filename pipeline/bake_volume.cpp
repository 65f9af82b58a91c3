// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/bake_volume.h>

#include <utility>

#include <tetralight/bake/bake_accumulators.h>
#include <tetralight/bake/occlusion_channels.h>
#include <tetralight/bake/project_environment.h>
#include <tetralight/bake/rays/memory_estimate.h>
#include <tetralight/bake/round_plan.h>
#include <tetralight/base/contract.h>
#include <tetralight/base/stopwatch.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/pipeline/bake_key.h>
#include <tetralight/pipeline/bake_metadata.h>
#include <tetralight/pipeline/walls_metadata.h>
#include <tetralight/probes/build/make_probe_volume.h>

namespace tetralight {
namespace {

/// The layers that the bake will fill.
void store_layers(const Scene& scene, const LightingPlan& plan, uint32_t thread_count,
                  ProbeVolume& volume) {
    for (uint32_t i = 0; i < plan.layer_names.size(); ++i) {
        const uint32_t rest = plan.has_rest() ? plan.bake.layer_count : kNoIndex;
        const bool has_sky = i == std::min(plan.bake.layer_of_sky, rest);
        volume.layers.emplace_back();
        if (has_sky) volume.layers[i].ambient = volume.info.ambient;
        volume.layer_names += plan.layer_names[i] + "\n";
    }
    if (plan.bake.has_transfer) volume.sky = {project_sky(scene.environment, thread_count)};
}

/// The lights whose visibility each probe stores.
void store_occlusion_lights(const LightingPlan& plan, ProbeVolume& volume) {
    if (!plan.bake.has_occlusion) return;
    const std::vector<uint32_t> channels = channels_of(plan.light_states);
    for (const glm::dvec3& position : volume.exact_positions) {
        volume.occlusion_lights.push_back(occlusion_lights_at(position, plan.lights, channels));
    }
}

/// Stores what is known of the light before the bake: ambient light, lights, layers, metadata.
void store_lights(const Scene& scene, const LightingPlan& plan, PreparedBake& prepared) {
    TETRALIGHT_ASSERT(scene.light_names.size() == scene.lights.size(), "one name for each light");
    const BakeVolumeSettings& settings = prepared.settings;
    ProbeVolume& volume = prepared.volume;
    volume.info.ambient = irradiance_from_radiance(
        project_environment(scene.environment, settings.bake.thread_count));
    volume.lights = plan.lights;
    const bool has_states = settings.lighting != LightingSettings{};
    if (has_states) volume.light_states = plan.light_states;
    store_layers(scene, plan, settings.bake.thread_count, volume);
    store_occlusion_lights(plan, volume);
    for (const std::string& name : scene.light_names) volume.light_names += name + "\n";
    const auto& group_dering = prepared.merged.group_dering;
    const bool has_dering = settings.dering.is_for_all_groups ||
                            std::ranges::find(group_dering, true) != group_dering.end();
    volume.metadata = bake_metadata(scene, settings, !prepared.overrides.empty(), has_dering);
}

/// Measures the free space that sees no probe of its cell, and stores it with what else the bake
/// found of walls.
void store_unseen(const TraceScene& traced, PreparedBake& prepared) {
    ProbeVolume& volume = prepared.volume;
    BakeReport& report = prepared.report;
    if (volume.positions.empty()) return;
    const Stopwatch watch;
    ProbeEyes eyes;
    for (const glm::dvec3& position : prepared.capture_positions) {
        eyes.positions.push_back(traced.render_from_world(position));
    }
    eyes.is_inside.assign(prepared.is_invalid.begin(), prepared.is_invalid.end());
    const FreePlaceSettings settings{.count = kUnseenPlaceCount,
                                     .min_validity = prepared.settings.health.min_validity,
                                     .thread_count = prepared.settings.bake.thread_count};
    report.unseen =
        find_unseen(find_free_places(traced, eyes, std::as_const(volume).view(), settings));
    const VisibilityReport& walls = report.visibility;
    volume.metadata = add_walls(volume.metadata, {.edge_count = walls.edge_count,
                                                  .blocked_edge_count = walls.blocked_edge_count,
                                                  .marked_cell_count = walls.marked_cell_count,
                                                  .unclear_cell_count = walls.unclear_cell_count,
                                                  .left_out_count = walls.left_out_count,
                                                  .unseen = report.unseen});
    report.unseen_seconds = watch.seconds();
}

}  // namespace

Result<PreparedBake> prepare_bake(const Scene& scene, std::span<const ProbeGroup> groups,
                                  const BakeVolumeSettings& settings) {
    if (auto status = RoundPlan::check(settings.bake); !status) return status.error();
    size_t position_count = 0;
    for (const ProbeGroup& group : groups) position_count += group.positions.size();
    auto plan = plan_lighting(scene, settings.lighting);
    if (!plan) return plan.error();
    const LightGroupLayout split(plan->bake);
    if (auto status = check_bake_memory(estimate_bake_memory(scene, position_count, split.size()));
        !status) {
        return status.error();
    }
    PreparedBake prepared;
    prepared.settings = settings;
    prepared.settings.bake.plan = plan->bake;
    BakeReport& report = prepared.report;
    Stopwatch watch;
    auto merged = merge(groups, settings.merge);
    if (!merged) return merged.error();
    report.welded_count = merged->welded_count();
    report.lattice_group_names = merged->lattice_group_names();
    report.largest_snap = merged->largest_snap;
    report.merge_seconds = watch.lap();

    const auto traced = TraceScene::make_static(scene);
    if (!traced) return traced.error();
    const uint32_t thread_count = settings.bake.thread_count;
    PreparedProbes probes =
        prepare_probes(scene, *traced, std::move(*merged), settings.health, thread_count);
    report.virtual_offset_count = probes.virtual_offset_count;
    report.left_out_count = probes.left_out_count;
    report.warnings = std::move(probes.warnings);
    report.warnings.insert(report.warnings.end(), plan->warnings.begin(), plan->warnings.end());
    prepared.merged = std::move(probes.merged);
    prepared.capture_positions = std::move(probes.capture_positions);
    prepared.is_invalid = std::move(probes.is_invalid);
    prepared.overrides = find_overrides(scene.probe_adjustments, prepared.merged.positions);
    report.prepare_seconds = watch.lap();

    prepared.volume = make_probe_volume(prepared.merged);
    override_rendering_layers(scene.probe_adjustments, prepared.volume);
    prepared.volume.health = std::move(probes.health);
    report.tetrahedralize_seconds = watch.lap();
    report.visibility =
        bake_visibility(*traced, prepared.capture_positions, thread_count, prepared.volume);

    store_lights(scene, *plan, prepared);
    store_unseen(*traced, prepared);
    prepared.key = bake_key(prepared);
    return prepared;
}

Result<BakedVolume> bake_volume(const Scene& scene, std::span<const ProbeGroup> groups,
                                const BakeVolumeSettings& settings, const BakeCallback& callback) {
    auto prepared = prepare_bake(scene, groups, settings);
    if (!prepared) return prepared.error();
    Stopwatch watch;
    std::vector<ProbeAccumulator> accumulators(prepared->capture_positions.size());
    const BakeSettings& with_plan = prepared->settings.bake;
    std::vector<double> rows(LightGroupLayout(with_plan.plan).size() * accumulators.size());
    const auto status =
        bake_accumulators(scene, {prepared->capture_positions}, with_plan, accumulators,
                          {.progress = callback}, {rows, prepared->volume.occlusion_lights});
    if (!status) return status.error();
    BakedVolume baked = finish_bake(std::move(*prepared), accumulators, rows);
    baked.report.bake_seconds = watch.lap();
    return baked;
}

}  // namespace tetralight
