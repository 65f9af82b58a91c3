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

/// A scene and the positions at which its light is measured.
struct BakeSubject {
    std::string name;
    Scene scene;
    std::vector<glm::dvec3> probes;
};

/// Adds a sun and a grey sky to a scene without light.
void light_if_dark(Scene& scene);

/// Positions in the scene's box that are not inside geometry: `count` or fewer.
[[nodiscard]] std::vector<glm::dvec3> free_positions(const Scene& scene, size_t count);

/// Every fourth probe.
[[nodiscard]] std::vector<glm::dvec3> some_probes(const BakeSubject& subject);

/// The courtyard with its own probes, the scene of the options, and a room with 10 000 emitters;
/// with `--only` none but that.
[[nodiscard]] std::vector<BakeSubject> bake_subjects(const Options& options);

enum class RoomLight { Sun, SkyOnly };

/// Five rooms of 5 × 3 × 4 m behind each other, with doors that overlap in part. All their light
/// comes through one window of 0.72 m² in the first room: of the sun and a uniform sky ("rooms"),
/// or of the sky alone ("rooms_sky").
[[nodiscard]] BakeSubject rooms_subject(RoomLight light);
[[nodiscard]] const char* rooms_name(RoomLight light);

/// Writes a line for each scene, method and number of rays a probe: the relative error.
void write_convergence(const std::string& path, const Options& options);

/// Time to an error of 1 %, against a plain path tracer.
void bench_bake_time(const BakeSubject& subject, const Options& options);

/// Rays a second of the whole baker, against tracing the same rays only.
void bench_bake_rays(const BakeSubject& subject, const Options& options);

/// Errors, error bars and seconds of bakes at default settings.
void bench_bake_noise(const BakeSubject& subject, const Options& options);

/// Errors of the layers of a bake at default settings, each against a longer bake of its light
/// alone.
void bench_bake_layers(const BakeSubject& subject, const Options& options);

/// Light and time of a bake with the default number of bounces, against one with 4.
void bench_bake_bounces(const BakeSubject& subject, const Options& options);

/// A white room (albedo 0.9), lit by the sun and the sky through a window.
[[nodiscard]] BakeSubject white_room();

/// Agreement of the baker's validity with the winding number on which positions are inside closed
/// meshes.
void bench_bake_validity();

/// A grey room of 20 × 6 × 20 m, with 10 000 emitters of 2 × 2 cm in it, with different colours and
/// strengths.
[[nodiscard]] Scene emitter_room();

}  // namespace tetralight::bench
