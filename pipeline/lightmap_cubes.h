// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include <tetralight/bake/reflection/bake_cubes.h>
#include <tetralight/bake/reflection/path_cubes.h>
#include <tetralight/bake/sampling/sobol.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/lightmap/lightmaps.h>
#include <tetralight/probes/light.h>

namespace tetralight {

/// Samples the light of cubes by one ray each: the surface that the ray hits shines by its emission
/// and reflects the light of its lightmap, and that of mixed lights, which lightmaps leave to
/// games, with one shadow ray each. Where there is no lightmap, the ray continues as a path. The
/// mean is that of `PathCubes` but for the size and the errors of the texels. Thread-safe.
class LightmapCubes {
  public:
    /// Keeps references. Returns the errors of `check_lightmap_scene`, and invalid_argument (field
    /// "lightmaps") if they were relit: emission and sky would have other weights.
    [[nodiscard]] static Result<LightmapCubes> make(const Scene& scene, const PathCubes& paths,
                                                    const LightmapsView& lightmaps);

    /// A sample of a texel, as `SampleCube` asks for it. Layers stay 0.
    [[nodiscard]] CubeSample sample(const glm::dvec3& position, glm::vec3 direction, float spread,
                                    const Sampler& sampler) const;

  private:
    LightmapCubes(const Scene& scene, const PathCubes& paths, const LightmapsView& lightmaps,
                  std::vector<Light> mixed_lights)
        : scene_(scene),
          paths_(paths),
          lightmaps_(lightmaps),
          mixed_lights_(std::move(mixed_lights)) {}

    [[nodiscard]] bool has_lightmap(const Surface& surface) const;
    /// Irradiance of the lights that are not in the lightmaps. Adds to `ray_count`.
    [[nodiscard]] glm::vec3 mixed_irradiance(const Surface& surface, Sampler& sampler,
                                             uint32_t& ray_count) const;

    const Scene& scene_;
    const PathCubes& paths_;
    LightmapsView lightmaps_;
    std::vector<Light> mixed_lights_;  ///< in render space
};

}  // namespace tetralight
