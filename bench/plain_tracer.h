// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <random>
#include <vector>

#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/probes/sh.h>

namespace tetralight::bench {

/// A path tracer without the baker's sampling: independent uniform directions, one emitter chosen
/// uniformly at each vertex, no multiple importance sampling, and Russian roulette by the
/// throughput after three bounces. Its expected result is the same.
class PlainTracer {
  public:
    /// Keeps references.
    PlainTracer(const Scene& scene, const TraceScene& traced);

    [[nodiscard]] RadianceSh gather(glm::vec3 origin, uint32_t sample_count, uint64_t seed);

  private:
    using Triangle = std::array<glm::vec3, 3>;

    [[nodiscard]] glm::vec3 trace(Ray ray);
    [[nodiscard]] glm::vec3 reflected_light(const Surface& surface, glm::vec3 origin);
    [[nodiscard]] glm::vec3 light_of(const Triangle& triangle, const Surface& surface,
                                     glm::vec3 origin);

    [[nodiscard]] float next() { return uniform_(engine_); }

    const Scene& scene_;
    const TraceScene& traced_;
    std::vector<Light> lights_;
    std::vector<Triangle> emitters_;
    std::mt19937_64 engine_;
    std::uniform_real_distribution<float> uniform_{0.0f, 1.0f};
};

}  // namespace tetralight::bench
