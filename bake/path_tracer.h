// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "bake/sampling.h"
#include "bake/scene/scene.h"
#include "bake/trace_scene.h"

namespace tetralight {

/// What the first segment of a path found, and the light that came along it.
struct PathSample {
    glm::vec3 radiance{0.0f};
    /// The first hit was the back of a single-sided surface: the path began inside something.
    bool is_behind_surface = false;
    uint32_t ray_count = 0;
};

/// Estimates radiance by tracing paths through a scene of Lambert surfaces, with next-event
/// estimation for its lights. Thread-safe.
class PathTracer {
  public:
    /// Keeps references. `bounces` is the number of reflections that light may take before it
    /// arrives; 0 = only emission and sky are seen.
    PathTracer(const Scene& scene, const TraceScene& traced, uint32_t bounces);

    /// Radiance that arrives at `origin` (traced space) from a unit direction. The direct light of
    /// punctual lights is no part of it: no ray meets a point.
    [[nodiscard]] PathSample trace(glm::vec3 origin, glm::vec3 direction,
                                   RandomStream random) const;

    /// What reaches a position (traced space) straight from one light, shadows included: zero
    /// irradiance when blocked.
    [[nodiscard]] Illumination visible_light(const Light& traced_light, glm::vec3 position) const;

    /// The scene's lights in traced space, in its order.
    [[nodiscard]] const std::vector<Light>& traced_lights() const { return lights_; }

  private:
    /// Light of all lights that the surface reflects, over its albedo. Shadow rays start at
    /// `ray_origin`; the light is that of the surface itself, which is some way off in large
    /// scenes.
    [[nodiscard]] glm::vec3 reflected_light(const Surface& surface, glm::vec3 ray_origin,
                                            uint32_t& ray_count) const;

    const Scene& scene_;
    const TraceScene& traced_;
    std::vector<Light> lights_;
    uint32_t bounces_;
};

}  // namespace tetralight
