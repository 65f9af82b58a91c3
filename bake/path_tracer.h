// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include <tetralight/bake/light_plan.h>
#include <tetralight/bake/lights/light_sampler.h>
#include <tetralight/bake/path_light_groups.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/sampling/sobol.h>
#include <tetralight/bake/scene/scene.h>

namespace tetralight {

/// How the light of emissive triangles and environment images is found. All three have the same
/// mean.
enum class LightStrategy {
    Mis,        ///< light and BSDF sampling, weighted by multiple importance sampling: the default
    LightOnly,  ///< light sampling only
    BsdfOnly,   ///< BSDF sampling only
};

struct PathSettings {
    /// Reflections that light may take before it arrives; 0 = only emission and sky are seen.
    uint32_t bounces = 4;
    /// Largest radiance (of the brightest channel) that reflected light along one path may have;
    /// what is brighter is darkened to it, which loses light. 0 = nothing is.
    float clamp = 0.0f;
    LightStrategy strategy = LightStrategy::Mis;

    bool operator==(const PathSettings&) const = default;
};

/// Where a path begins.
struct PathStart {
    glm::vec3 origin{0.0f};     ///< render space
    glm::vec3 direction{0.0f};  ///< unit vector
    /// Density of the direction, per steradian, for each emitter that is drawn at the origin too
    /// (`sample_emission`); infinite = none is.
    float pdf = std::numeric_limits<float>::infinity();
};

/// What the first segment of a path found, and the light that came along it.
struct PathSample {
    glm::vec3 radiance{0.0f};
    /// The first hit was the back of a single-sided surface: the path began inside something.
    bool hit_back_face = false;
    uint32_t ray_count = 0;
};

/// Estimates radiance by tracing paths through a scene of Lambert surfaces. At each surface one
/// emitter of each kind is drawn (next-event estimation), weighted against meeting it by chance
/// (Veach & Guibas 1995, "Optimally Combining Sampling Techniques", the power heuristic); paths
/// that carry little are ended at random without bias. Thread-safe.
class PathTracer {
  public:
    /// Keeps references to the scenes. The plan says which lights are baked, and splits paths.
    PathTracer(const Scene& scene, const TraceScene& trace_scene, const PathSettings& settings,
               const LightPlan& plan = {});

    /// Radiance that arrives along a path. The direct light of punctual and area lights is no part
    /// of it: no ray meets them. `light_groups`: where it came from; the sum has the same bits with
    /// it.
    [[nodiscard]] PathSample trace(const PathStart& start, Sampler sampler,
                                   PathLightGroups* light_groups = nullptr) const;

    /// Whether anything that rays meet by chance can be drawn as well.
    [[nodiscard]] bool can_sample_emission() const;

    /// Light straight from one emissive triangle or direction of the sky (`kind`), weighted against
    /// meeting it by chance with density `bsdf_pdf`. Zero irradiance when blocked.
    [[nodiscard]] LightSample sample_emission(LightKind kind, const ShadingPoint& shading_point,
                                              float bsdf_pdf, Sampler& sampler) const;

    /// Whether something stands between a position and the light of a sample. `blend` in [0, 1)
    /// draws anew what lets a part of the rays through.
    [[nodiscard]] bool occluded(glm::vec3 origin, const LightSample& sample,
                                float blend = 0.0f) const;

    /// The lights whose direct light belongs into probes, in the scene's order, in render space.
    [[nodiscard]] const std::vector<Light>& baked_lights() const { return baked_lights_; }

    /// The layer of one of them.
    [[nodiscard]] uint32_t layer_of_baked_light(size_t light) const {
        return layer_of_baked_light_[light];
    }

    /// The layer of what was drawn.
    [[nodiscard]] uint32_t layer_of(LightKind kind, const LightSample& sample) const;

    [[nodiscard]] const LightPlan& plan() const { return plan_; }

    [[nodiscard]] const TraceScene& trace_scene() const { return trace_scene_; }

    [[nodiscard]] const LightSampler& light_sampler() const { return light_sampler_; }

  private:
    /// What is known of a path while it is followed.
    struct Path {
        Sampler sampler;
        glm::vec3 throughput{1.0f};
        uint32_t ray_count = 0;
        PathLightGroups* light_groups = nullptr;

        void add(uint32_t layer, glm::vec3 light, PathLightGroups::Arrival arrival) const {
            if (light_groups != nullptr) light_groups->add(layer, light, arrival);
        }
    };

    /// Light that a surface reflects straight from emitters, over its albedo.
    [[nodiscard]] glm::vec3 reflected_light(const Surface& surface, Path& path) const;
    [[nodiscard]] uint32_t layer_of_geometry(uint32_t geometry) const;
    [[nodiscard]] float mis_weight_light(float pdf, float bsdf_pdf) const;
    [[nodiscard]] float mis_weight_bsdf(float pdf, float emitter_pdf) const;

    const Scene& scene_;
    const TraceScene& trace_scene_;
    PathSettings settings_;
    LightPlan plan_;
    LightSampler light_sampler_;
    std::vector<Light> baked_lights_;
    std::vector<uint32_t> layer_of_baked_light_;
};

}  // namespace tetralight
