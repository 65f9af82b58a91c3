// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <tetralight/bake/bake_settings.h>
#include <tetralight/bake/path_tracer.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/reflection/bake_cubes.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// Samples the light of cubes by paths through the static objects of a scene: the light that a
/// probe bakes but for the direct light of `Baked` lights, whose sources a mirror would show. That
/// is the sky, emission, and what surfaces reflect of all lights. Objects with `is_in_reflections`
/// false are not seen, but light what is. Thread-safe.
class PathCubes {
  public:
    /// Keeps a reference to the scene. Openings are used as for probes. Layers are those of
    /// `settings.plan`. Returns the errors of `TraceScene::make_static`.
    [[nodiscard]] static Result<PathCubes> make(const Scene& scene, const BakeSettings& settings);

    /// A sample of a texel, as `SampleCube` asks for it. `layers`: receives the light of each layer
    /// of the plan.
    [[nodiscard]] CubeSample sample(const glm::dvec3& position, glm::vec3 direction, float spread,
                                    const Sampler& sampler, std::span<glm::vec3> layers) const;

    /// The surface that `sample` sees first; none if it sees the sky. Adds to `ray_count`.
    [[nodiscard]] std::optional<Surface> first_surface(const glm::dvec3& position,
                                                       glm::vec3 direction, float spread,
                                                       uint32_t& ray_count) const;

    [[nodiscard]] const TraceScene& trace_scene() const { return *trace_scene_; }

  private:
    PathCubes(const Scene& scene, TraceScene trace_scene, const BakeSettings& settings);

    [[nodiscard]] PathStart start(const glm::dvec3& position, glm::vec3 direction,
                                  float spread) const;

    std::unique_ptr<const TraceScene> trace_scene_;
    std::unique_ptr<const PathTracer> tracer_;
    std::vector<bool> is_hidden_;  ///< one an instance
};

}  // namespace tetralight
