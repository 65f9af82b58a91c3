// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/verify/verify_report.h>

// Asks Cycles, the path tracer of Blender, for light: Blender imports the glTF file by its own
// importer, and a script (verify/cycles_referee.py) renders small panoramas at the positions.

namespace tetralight {

/// The script that Blender runs.
extern const char* const kCyclesScript;

struct CyclesJob {
    /// The program; without a slash it is looked up in PATH.
    std::string blender = "blender";
    /// The glTF file that `scene` was read from.
    std::string scene_path;
    /// World positions, and the relative standard error that is aimed at for each.
    std::vector<glm::dvec3> positions;
    std::vector<double> target_errors;
    /// Above 0: so many paths at each position.
    uint64_t sample_count = 0;
    uint64_t max_sample_count = 1 << 22;
    uint32_t bounces = 1000;
    uint64_t seed = 0;
    /// 0 = all.
    uint32_t thread_count = 0;
    /// Blender is ended after this time; 0 = never.
    std::chrono::milliseconds time_limit{0};
    /// Called with the number of positions that are done; false ends Blender.
    std::function<bool(size_t)> progress;
};

struct CyclesResult {
    /// "Cycles 3.4.1".
    std::string referee;
    /// One for each position.
    std::vector<TracedLight> lights;
};

/// Lights and sky are those of `scene`; `light_modes` has one element a light. Files are written to
/// a temporary folder, which is removed.
///
/// Returns unsupported if Cycles cannot render what was baked (direct light, falloffs that glTF
/// does not have, no reflection), or if Blender does not run or does not import the scene;
/// unsupported if the time limit ended it, cancelled if the callback did.
[[nodiscard]] Result<CyclesResult> trace_by_cycles(const Scene& scene,
                                                   const std::vector<LightMode>& light_modes,
                                                   const CyclesJob& job);

/// Mean light from rounds that are independent: nine RGB coefficients of radiance each. The
/// standard error follows from their spread. Precondition: two rounds or more.
[[nodiscard]] TracedLight mean_of_rounds(const std::vector<RadianceSh>& rounds,
                                         uint64_t sample_count);

}  // namespace tetralight
