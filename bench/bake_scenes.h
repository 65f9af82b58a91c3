// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/bench/harness.h>
#include <tetralight/probes/sh.h>

namespace tetralight::bench {

/// Number of bounces in all benchmarks.
inline constexpr uint32_t kBounces = 4;

/// A scene and the positions at which its light is measured.
struct BakeSubject {
    std::string name;
    Scene scene;
    std::vector<glm::dvec3> probes;
};

/// The courtyard with its own probes, the scene of the options, and a room with 10 000 emitters.
[[nodiscard]] std::vector<BakeSubject> bake_subjects(const Options& options);

/// Root mean square error of irradiance over 26 normals, as a fraction of the mean irradiance.
[[nodiscard]] double relative_rmse(const RadianceSh& a, const RadianceSh& reference);

/// Writes a line for each scene, method and number of rays a probe: the relative error.
void write_convergence(const std::string& path, const Options& options);

/// Rays a second of the whole baker, against tracing the same rays only.
void bench_bake_rays(const BakeSubject& subject, const Options& options);

/// Agreement of the baker's validity with the winding number on which positions are inside closed
/// meshes.
void bench_bake_validity();

/// A grey room of 20 × 6 × 20 m, with 10 000 emitters of 2 × 2 cm in it, with different colours and
/// strengths.
[[nodiscard]] Scene emitter_room();

}  // namespace tetralight::bench
