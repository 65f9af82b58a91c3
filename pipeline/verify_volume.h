// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <tetralight/bake/bake_progress.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/verify/trace_light.h>
#include <tetralight/verify/verify_report.h>

// Compares a volume with a referee, in three steps of which another referee replaces the second:
//
//     prepare_verify → trace_report (verify/plain_tracer.h) → finish_verify

namespace tetralight {

struct VerifySettings {
    /// Probes of the volume to compare, at most.
    uint32_t probe_count = 400;
    /// Places between them, at most. 0: none.
    uint32_t place_count = 400;
    /// Least distance of places from surfaces, metres.
    float clearance = 0.05f;
    /// Of probes. `seed` is ignored.
    TraceEffort effort;
    /// Target error of places: `effort.target_error` times this.
    double place_error_factor = 4.0;
    /// Most reflections of a path; empty: as many as the bake had.
    std::optional<uint32_t> bounces;
    /// No position is begun after so many seconds of tracing; 0: no limit. With it, the result
    /// depends on the speed of the machine.
    double time_limit_seconds = 0.0;
    VerifyRules rules;
    VerifyLimits limits;
    /// Of the choice of probes and places, and of the paths.
    uint64_t seed = 0;
    /// Number of threads; 0 = all.
    uint32_t thread_count = 0;
};

/// Probes and places with the light of the volume, and none of the referee. Probes are chosen at
/// random, one in each of as many equal runs along the curve that orders them. Dilated ones, those
/// inside geometry and those whose light an adjustment volume changes are left out. Places are
/// those of `find_free_places`. A volume with layers is taken as it was baked, with all weights 1.
///
/// Light that is stored in halves alone is used as it is.
///
/// Returns invalid_argument if neither probes nor places are asked for, and if the volume holds no
/// light or was relit; not_found if no probe and
/// no place is left; and the errors of `recorded_settings` and `TraceScene::make_static`.
[[nodiscard]] Result<VerifyReport> prepare_verify(const Scene& scene, const ProbeVolumeView& volume,
                                                  const VerifySettings& settings);

/// Traces the light of all positions of a report, for lights, surfaces and bounces as the volume's
/// metadata records them. Positions for which there was no time are removed. The same result for
/// any number of threads. Returns cancelled if the callback returns false, and invalid_argument
/// with the field "time_limit" if there was time for no probe, or for no place, of those in the
/// report.
[[nodiscard]] Status trace_report(const Scene& scene, const ProbeVolumeView& volume,
                                  const VerifySettings& settings, VerifyReport& report,
                                  const BakeCallback& callback = {});

/// The program that traces in place of the referee of this library.
struct CyclesProgram {
    /// Blender: a path, or a name that is looked up in PATH.
    std::string blender = "blender";
    /// The glTF file that the scene was read from.
    std::string scene_path;
};

/// The same by Cycles (verify/cycles_referee.h), which shares neither loader nor rays with the
/// baker. Also returns unsupported if the bake changed the albedo of surfaces, and the errors of
/// `trace_by_cycles`.
[[nodiscard]] Status trace_report_by_cycles(const Scene& scene, const ProbeVolumeView& volume,
                                            const VerifySettings& settings,
                                            const CyclesProgram& program, VerifyReport& report,
                                            const BakeCallback& callback = {});

/// Compares both and checks the limits.
void finish_verify(const VerifySettings& settings, VerifyReport& report);

/// All three steps.
[[nodiscard]] Result<VerifyReport> verify_volume(const Scene& scene, const ProbeVolumeView& volume,
                                                 const VerifySettings& settings,
                                                 const BakeCallback& callback = {});

}  // namespace tetralight
