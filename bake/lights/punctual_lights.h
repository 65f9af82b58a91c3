// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <tetralight/bake/lights/light_tree.h>
#include <tetralight/bake/lights/sample_light.h>
#include <tetralight/bake/sampling/sobol.h>
#include <tetralight/probes/light.h>

namespace tetralight {

/// Light bounds of a point, spot, rectangle or disc light. Precondition: not directional.
[[nodiscard]] LightBounds light_bounds_of(const Light& light) noexcept;

/// Samples one of many lights and a point of its shape: directional lights by their irradiance, the
/// other ("local") lights by a light tree.
class PunctualLights {
  public:
    PunctualLights() = default;
    /// Lights without intensity are never sampled. `LightSample::source` is an index into `lights`.
    explicit PunctualLights(std::span<const Light> lights);

    [[nodiscard]] bool has_directional() const { return !directional_.empty(); }

    [[nodiscard]] bool has_local() const { return !tree_.is_empty(); }

    [[nodiscard]] std::vector<std::pair<Light, uint32_t>> directional_lights() const;

    /// Light of one directional light, without shadows. Takes two pairs of sample dimensions.
    [[nodiscard]] LightSample sample_directional(const ShadingPoint& shading_point,
                                                 Sampler& sampler) const noexcept;

    /// Light of one local light, without shadows. Takes two pairs of sample dimensions.
    [[nodiscard]] LightSample sample_local(const ShadingPoint& shading_point,
                                           Sampler& sampler) const noexcept;

  private:
    std::vector<Light> directional_;
    std::vector<Light> local_;
    std::vector<uint32_t> directional_sources_;  // indices into all lights
    std::vector<uint32_t> local_sources_;
    LightTree tree_;  // of `local_`
};

}  // namespace tetralight
