// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include <tetralight/pipeline/bake_metadata.h>
#include <tetralight/pipeline/lighting_plan.h>
#include <tetralight/pipeline/verify_volume.h>
#include <tetralight/verify/cycles_referee.h>

namespace tetralight {
namespace {

CyclesJob cycles_job(const VerifySettings& settings, const CyclesProgram& program,
                     const VerifyReport& report) {
    CyclesJob job;
    job.blender = program.blender;
    job.scene_path = program.scene_path;
    job.sample_count = settings.effort.sample_count;
    job.max_sample_count = settings.effort.max_sample_count;
    job.bounces = report.bounces;
    job.seed = settings.seed;
    job.thread_count = settings.thread_count;
    job.time_limit = std::chrono::milliseconds(
        static_cast<int64_t>(std::ceil(1000.0 * settings.time_limit_seconds)));  // 0: no limit
    const double target = settings.effort.target_error;
    for (const VerifyProbe& probe : report.probes) {
        job.positions.push_back(probe.position);
        job.target_errors.push_back(target);
    }
    for (const VerifyPlace& place : report.places) {
        job.positions.push_back(place.position);
        job.target_errors.push_back(target * settings.place_error_factor);
    }
    return job;
}

void set_notes(VerifyReport& report) {
    if (!report.notes.empty()) report.notes.erase(report.notes.begin());
    report.notes.insert(
        report.notes.begin(),
        {"Cycles has the importer of Blender, and rays and samples of its own. It shares with the "
         "baker the lights and the sky that the command read, and the choice of free places.",
         "Surfaces reflect diffusely with the albedo of the baker, computed in Cycles from the "
         "imported materials; their specular reflection is not compared.",
         "Error bars of Cycles come from 16 rounds with different seeds."});
}

}  // namespace

Status trace_report_by_cycles(const Scene& scene, const ProbeVolumeView& volume,
                              const VerifySettings& settings, const CyclesProgram& program,
                              VerifyReport& report, const BakeCallback& callback) {
    const auto recorded = recorded_settings(volume.metadata);
    if (!recorded) return recorded.error();
    if (!(recorded->bake.surfaces == SurfaceSettings{})) {
        return Error{ErrorCode::Unsupported, "volume", "",
                     "the bake changed the albedo of surfaces, which is not compared with Cycles"};
    }
    auto plan = plan_lighting(scene, {recorded->lighting.mixed_lighting, {}});
    if (!plan) return plan.error();
    CyclesJob job = cycles_job(settings, program, report);
    ProgressReporter progress(callback, job.positions.size());
    size_t shown = 0;
    job.progress = [&](size_t done) {
        for (; shown < done; ++shown)
            progress.add_round({.is_first = true, .state = {.is_done = true}});
        progress.add_rays(0);
        return !progress.is_cancelled();
    };
    auto light_modes = plan->bake.light_modes;
    if (light_modes.empty()) {
        for (const Light& light : scene.lights) light_modes.push_back(light.mode);
    }
    auto result = trace_by_cycles(scene, light_modes, job);
    if (!result) return result.error();
    progress.finish();
    report.referee = result->referee;
    set_notes(report);
    for (size_t i = 0; i < report.probes.size(); ++i) report.probes[i].traced = result->lights[i];
    for (size_t i = 0; i < report.places.size(); ++i)
        report.places[i].traced = result->lights[report.probes.size() + i];
    return Ok{};
}

}  // namespace tetralight
