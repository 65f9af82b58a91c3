// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "bake/emissive_triangles.h"
#include "bake/environment_sampler.h"
#include "bake/lamps.h"
#include "bake/light_tree.h"
#include "bake/sample_light.h"
#include "bake/scene/scene.h"
#include "bake/sobol.h"
#include "bake/trace_scene.h"

namespace tetralight {

/// Kinds of emitters that are drawn from apart, as their light does not compare before shadows are
/// known.
enum class EmitterKind { Sun, Lamp, Triangle, Sky };

/// All that shines in a scene, to be sampled. Traced space.
class Emitters {
  public:
    /// Lights count as bounces see them, `indirect_multiplier` included. Keeps references.
    Emitters(const Scene& scene, const TraceScene& traced);

    [[nodiscard]] bool has(EmitterKind kind) const noexcept;

    /// Light of one emitter of a kind that the scene has, drawn at random; shadows left out.
    [[nodiscard]] LightSample sample(EmitterKind kind, const Receiver& receiver,
                                     PathNumbers& numbers) const noexcept;

    /// Density per steradian with which `sample` draws what a ray from the receiver met by chance:
    /// a triangle, or the sky in a direction. 0 = never.
    [[nodiscard]] float pdf(const Receiver& receiver, const Surface& met) const noexcept {
        return triangles_.pdf(receiver, met);
    }

    [[nodiscard]] float pdf(glm::vec3 sky_direction) const noexcept {
        return sky_.pdf(sky_direction);
    }

  private:
    [[nodiscard]] LightSample sample_sky(glm::vec2 u) const noexcept;

    const Environment& environment_;
    Lamps lamps_;
    EmissiveTriangles triangles_;
    EnvironmentSampler sky_;
};

}  // namespace tetralight
