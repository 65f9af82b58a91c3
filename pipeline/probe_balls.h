// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "bake/ray_caster.h"
#include "base/result.h"
#include "lppv/lppv.h"
#include "pipeline/render_scene.h"
#include "probes/probe_volume.h"

namespace tetralight {

/// The probes of a volume as white balls, each lit by what it holds: they show where probes stand
/// and what light they found.
class ProbeBalls {
  public:
    /// Keeps references. Error: not enough memory.
    [[nodiscard]] static Result<ProbeBalls> make(const ProbeVolumeView& volume, float radius);

    /// The points of proxy volumes in the same manner. Keeps nothing.
    [[nodiscard]] static Result<ProbeBalls> make(std::span<const Lppv> volumes, float radius);

    struct Ball {
        uint32_t probe = 0;
        float distance = 0.0f;
        glm::vec3 normal{0.0f};
    };

    /// The first ball that a ray from a world position in a unit direction hits.
    [[nodiscard]] std::optional<Ball> find(const glm::dvec3& origin, glm::vec3 direction) const;

    [[nodiscard]] const ProbeVolumeView& volume() const { return volume_; }

    /// Radiance of the first ball that a ray from a world position in a unit direction hits.
    [[nodiscard]] std::optional<SceneShader::Shaded> shade(const glm::dvec3& origin,
                                                           glm::vec3 direction) const;

  private:
    explicit ProbeBalls(const ProbeVolumeView& volume) : volume_(volume) {}

    ProbeVolumeView volume_;
    std::vector<IrradianceSh> own_light_;  // of proxy volumes, which volume_ then refers to
    RayCaster caster_;                     // in local space
};

}  // namespace tetralight
