// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/probes/sh.h>
#include <tetralight/verify/pcg.h>
#include <tetralight/verify/plain_lights.h>
#include <tetralight/verify/plain_sky.h>

// The referee: an unbiased path tracer that is as plain as one that ends. Of the baker it has the
// scene and its materials (bake/scene) and the rays (bake/rays), and nothing else: no light tree,
// no openings, no caches, no filtered textures, other random numbers.

namespace tetralight {

struct PlainTracerSettings {
    /// Most reflections of a path.
    uint32_t bounces = 1000;
    /// The mode of each light; empty = those of the scene.
    std::vector<LightMode> light_modes;
};

class PlainTracer {
  public:
    /// Paths of one batch: their first directions are one in each of 16 × 16 equal parts of the
    /// sphere.
    static constexpr uint32_t kBatchSize = 256;

    /// Keeps references to both scenes. The emission and the albedo are those of `traced`.
    PlainTracer(const Scene& scene, const TraceScene& traced, const PlainTracerSettings& settings);

    /// Radiance that arrives at a position in render space, as the mean over one batch of paths.
    /// The same `random` gives the same bits.
    [[nodiscard]] RadianceShSum trace_batch(glm::vec3 position, Pcg random) const;

    [[nodiscard]] const TraceScene& trace_scene() const { return traced_; }

  private:
    /// Radiance from the direction of the ray, but for lights that rays cannot hit.
    [[nodiscard]] glm::vec3 trace(Ray ray, Pcg& random) const;
    /// Light of all kinds that is sampled at a surface and reflected, divided by the albedo.
    [[nodiscard]] glm::vec3 reflected(const Surface& surface, glm::vec3 origin, Pcg& random) const;
    /// Light that is sampled at the start of paths.
    void add_first_light(glm::vec3 position, RadianceShSum& sum, Pcg& random) const;

    /// Light of a direction that was chosen by the emitters or by the sky: divided by the density,
    /// with the weight against directions of `other_pdf`.
    struct Found {
        glm::vec3 direction{0.0f};
        glm::vec3 irradiance{0.0f};
    };

    /// Density per steradian of directions that are chosen in other ways, from a normal; uniform
    /// without one.
    [[nodiscard]] static float chance_pdf(glm::vec3 normal, glm::vec3 direction);
    [[nodiscard]] Found find_emitter(glm::vec3 origin, glm::vec3 normal, Pcg& random) const;
    [[nodiscard]] Found find_sky(glm::vec3 origin, glm::vec3 normal, Pcg& random) const;
    [[nodiscard]] bool is_visible(glm::vec3 origin, const PlainLightSample& sample,
                                  Pcg& random) const;

    const TraceScene& traced_;
    uint32_t bounces_;
    PlainLights bounced_, baked_;
    PlainEmitters emitters_;
    PlainSky sky_;
};

}  // namespace tetralight
