// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <vector>

#include <tetralight/bake/all_bounces.h>
#include <tetralight/bake/light_plan.h>
#include <tetralight/bake/lights/light_sampler.h>
#include <tetralight/bake/lights/openings.h>
#include <tetralight/bake/path_light_groups.h>
#include <tetralight/bake/radiance_cache.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/sampling/sobol.h>
#include <tetralight/bake/scene/scene.h>

namespace tetralight {

/// How the light of emissive triangles and environment images is sampled. The expected value is the
/// same for all three.
enum class LightStrategy {
    Mis,        ///< light and BSDF sampling, combined by multiple importance sampling
    LightOnly,  ///< light sampling only
    BsdfOnly,   ///< BSDF sampling only
};

struct PathSettings {
    /// Maximum number of reflections; 0 = only emission and sky that the first segment hits.
    uint32_t bounces = kAllBounces;
    /// Upper limit of the reflected radiance of one path, by its brightest channel: brighter light
    /// is scaled down to it, which loses energy. 0 = no limit.
    float clamp = 0.0f;
    LightStrategy strategy = LightStrategy::Mis;
    /// Leaves out the light that arrives from its source along the first segment.
    bool is_reflected_only = false;

    bool operator==(const PathSettings&) const = default;

    /// False if openings and radiance caches are ignored: MIS weights and cached light hold for
    /// paths of any length and brightness only.
    [[nodiscard]] bool traces_all_light() const {
        return bounces == kAllBounces && clamp <= 0.0f && strategy == LightStrategy::Mis;
    }
};

/// The first ray of a path.
struct PathStart {
    glm::vec3 origin{0.0f};     ///< render space
    glm::vec3 direction{0.0f};  ///< unit vector
    /// Zero: paths start into all directions (`start_pdf`). A unit vector: into its hemisphere.
    glm::vec3 normal{0.0f};
    /// Paths for each light sample of each kind that is taken at the origin too
    /// (`sample_emission`); infinite = no light samples are taken there.
    float paths_per_light_sample = std::numeric_limits<float>::infinity();
    /// The weights at the origin, where `PathTracer::draw_from_openings` is called once for each
    /// path; null = it is not.
    const Openings::Weights* opening_weights = nullptr;
    /// Of the first ray, radians (`TraceScene::intersect`).
    float spread = TraceScene::kDiffuseSpread;
    /// One an instance of the scene: the first ray passes those that are hidden. Null = it hits
    /// all.
    const std::vector<bool>* is_hidden = nullptr;
};

/// Density per steradian of the directions in which paths start. Normal zero: uniform on the
/// sphere. Else that of `sample_start`.
[[nodiscard]] float start_pdf(glm::vec3 normal, glm::vec3 direction) noexcept;

/// A direction in the hemisphere of a unit normal, with density (3 cos θ / π + 1 / 2π) / 4: close
/// to the cosine, for the irradiance of a surface, and never near 0, for ∫ L dω and ∫ L ω dω. Its
/// `start_pdf` is above 0.
[[nodiscard]] glm::vec3 sample_start(glm::vec3 normal, glm::vec2 u) noexcept;

/// The radiance that one path found.
struct PathSample {
    glm::vec3 radiance{0.0f};
    /// The first ray hit the back face of a single-sided surface: it started inside geometry.
    bool hit_back_face = false;
    uint32_t ray_count = 0;
    // What `PathSettings::bounces` cuts off is estimated from these (`CutLight`).
    /// Reflected light of the highest order that is kept, before the clamp.
    glm::vec3 last_light{0.0f};
    /// Mean throughput over the channels on the segment after the last reflection; 0 if the path
    /// ended before.
    float last_throughput = 0.0f;
    /// The same after the surface at its end, where the path is cut; 0 if the segment escaped.
    float cut_throughput = 0.0f;
};

/// Estimates radiance by path tracing in a scene of Lambertian surfaces. At each surface one light
/// of each kind is sampled (next-event estimation), weighted by multiple importance sampling with
/// the power heuristic (Veach & Guibas 1995, "Optimally Combining Sampling Techniques"). Russian
/// roulette ends paths of low throughput. Thread-safe.
///
/// In enclosed places, where light enters through openings, each surface also samples a direction
/// through an opening and a point of a sunlit spot. Both reach their light by one more reflection;
/// weights by the power heuristic hold for that light alone.
class PathTracer {
  public:
    /// Keeps references to both scenes. The plan selects the baked lights and the light groups.
    /// `openings`: in render space. They do not change the expected value. `cache`: of the layers
    /// of the plan, outlives the tracer; null = paths end by themselves. Both are ignored unless
    /// `PathSettings::traces_all_light`.
    PathTracer(const Scene& scene, const TraceScene& trace_scene, const PathSettings& settings,
               const LightPlan& plan = {}, std::vector<Opening> openings = {},
               const RadianceCache* cache = nullptr);

    /// Radiance that arrives along a path. Excludes the direct light of punctual and area lights,
    /// which rays cannot hit. `light_groups` receives the same light by source, and does not change
    /// the bits of the result.
    [[nodiscard]] PathSample trace(const PathStart& start, Sampler sampler,
                                   PathLightGroups* light_groups = nullptr) const;

    /// The surface that the first ray of a path hits; none if it escapes. Adds to `ray_count`.
    [[nodiscard]] std::optional<Surface> first_surface(const PathStart& start,
                                                       uint32_t& ray_count) const;

    /// True if the strategy samples lights, the scene has emission that rays can hit, and its
    /// direct light counts.
    [[nodiscard]] bool can_sample_emission() const;

    /// Direct light of one emissive triangle or sky direction (`kind`) at the start of paths, with
    /// its MIS weight. Zero irradiance if occluded.
    [[nodiscard]] LightSample sample_emission(LightKind kind, const PathStart& start,
                                              Sampler& sampler) const;

    [[nodiscard]] const Openings& openings() const { return openings_; }

    /// Light that arrives at the start of paths by one reflection, from samples of openings.
    struct OpeningSample {
        glm::vec3 to_light{0.0f};
        /// Radiance divided by the density of the direction, with its MIS weight.
        glm::vec3 irradiance{0.0f};
    };

    /// Two samples at the start of paths: through an opening, and of a spot. Precondition: the
    /// start has the weights of openings.
    /// `light_samples`: number of light samples of each kind there for each path.
    /// `light_groups` (null or one each) receive their light by source. Adds to `ray_count`.
    [[nodiscard]] std::array<OpeningSample, 2> draw_from_openings(
        const PathStart& start, float light_samples, Sampler sampler,
        std::array<PathLightGroups*, 2> light_groups, uint64_t& ray_count) const;

    /// True if a surface lies between a position and the light of a sample. `blend_seed` in [0, 1)
    /// selects the random decisions of alpha-blended surfaces on the way.
    [[nodiscard]] bool occluded(glm::vec3 origin, const LightSample& sample,
                                float blend_seed = 0.0f) const;

    /// The lights whose direct light is baked, in the order of the scene, in render space.
    [[nodiscard]] const std::vector<Light>& baked_lights() const { return baked_lights_; }

    /// The layer of `baked_lights()[light]`, or kNoIndex.
    [[nodiscard]] uint32_t layer_of_baked_light(size_t light) const {
        return layer_of_baked_light_[light];
    }

    /// The layer of a sampled light, or kNoIndex.
    [[nodiscard]] uint32_t layer_of(LightKind kind, const LightSample& sample) const;

    [[nodiscard]] const LightPlan& plan() const { return plan_; }

    [[nodiscard]] const PathSettings& settings() const { return settings_; }

    [[nodiscard]] const TraceScene& trace_scene() const { return trace_scene_; }

    [[nodiscard]] const LightSampler& light_sampler() const { return light_sampler_; }

  private:
    /// State of a path between two surfaces.
    struct Path {
        Sampler sampler;
        Sampler draw_sampler;  ///< for samples of openings
        glm::vec3 throughput{1.0f};
        uint32_t ray_count = 0;
        PathLightGroups* light_groups = nullptr;

        void add(uint32_t layer, glm::vec3 light, PathLightGroups::Arrival arrival) const {
            if (light_groups != nullptr) light_groups->add(layer, light, arrival);
        }
    };

    /// What is drawn from openings at the start of a segment.
    struct Draws {
        ShadingPoint from;
        Openings::Weights weights;
        float directions = 0.0f;  ///< expected number of directions through openings
        float spots = 0.0f;       ///< expected number of points of spots
        /// Density of the direction of the segment among directions that are not drawn.
        float chance_pdf = 0.0f;
        /// The direction was drawn through an opening.
        bool is_drawn = false;
        /// At the start of a path.
        bool is_first = false;
        /// The light of the sky counts: it is not known from a cache.
        bool sees_sky = true;
    };

    [[nodiscard]] std::optional<Surface> next_surface(const Ray& ray, float spread,
                                                      uint32_t& ray_count) const;
    /// The same, and moves the origin of the ray past hidden instances.
    [[nodiscard]] std::optional<Surface> first_surface(const PathStart& start, Ray& ray,
                                                       uint32_t& ray_count) const;
    /// Direct light of all kinds that a surface reflects, divided by its albedo. `weight`: of all
    /// light but that of spots. Draws at the start of the segment that ends at the surface, and at
    /// the surface.
    [[nodiscard]] glm::vec3 reflected_light(const Surface& surface, Path& path, float weight,
                                            const Draws& arrival, const Draws& here) const;
    /// The texel of the cache at a surface that a ray from `origin` hit, if there is one.
    [[nodiscard]] std::optional<uint32_t> cached_texel(const Surface& surface,
                                                       glm::vec3 origin) const;

    /// Weights of the light of a texel.
    struct CacheWeights {
        float direct = 1.0f;  ///< but for the light of spots
        float reflected = 1.0f;
    };

    /// The light that a surface reflects as a texel of the cache has it, divided by its albedo.
    [[nodiscard]] glm::vec3 cached_light(const Surface& surface, uint32_t texel, Path& path,
                                         CacheWeights weights, const Draws& arrival) const;
    /// The light of one kind in `reflected_light`, as irradiance.
    [[nodiscard]] glm::vec3 sampled_irradiance(LightKind kind, const Surface& surface, Path& path,
                                               float weight, const Draws& arrival,
                                               const Draws& here) const;
    /// The other part of it: emission and sky that a ray in proportion to the cosine hits.
    [[nodiscard]] glm::vec3 reflected_by_chance(const Surface& surface, Path& path) const;
    /// MIS weight of the sky on a segment: against light samples and draws.
    [[nodiscard]] float sky_weight(const Draws& draws, glm::vec3 direction, float pdf) const;

    [[nodiscard]] Draws draws_at(const PathStart& start) const;
    [[nodiscard]] static float chance_pdf(const Draws& draws, glm::vec3 direction);
    [[nodiscard]] static Draws draws_with(const ShadingPoint& shading_point,
                                          const Openings::Weights& weights, float count);
    [[nodiscard]] Draws draws_at(const ShadingPoint& shading_point, float count) const;
    /// Expected number of draws of a direction per steradian.
    [[nodiscard]] float direction_density(const Draws& draws, glm::vec3 direction) const;
    /// Expected number of draws per steradian of a point of a spot that a light sample lights.
    [[nodiscard]] float spot_density(const Draws& draws, const Surface& surface,
                                     const LightSample& sample) const;
    [[nodiscard]] float spot_weight(const Draws& draws, const Surface& surface,
                                    const LightSample& sample, float weight) const;
    [[nodiscard]] OpeningSample draw_direction(const Draws& draws, glm::vec3 ray_origin,
                                               float light_samples, Path& path) const;
    [[nodiscard]] OpeningSample draw_spot(const Draws& draws, glm::vec3 ray_origin,
                                          Path& path) const;
    [[nodiscard]] glm::vec3 drawn_light(const Draws& draws, glm::vec3 ray_origin, Path& path) const;
    [[nodiscard]] uint32_t layer_of_geometry(uint32_t geometry) const;
    [[nodiscard]] float mis_weight_light(float light_pdf, float bsdf_pdf) const;
    [[nodiscard]] float mis_weight_bsdf(float bsdf_pdf, float light_pdf) const;

    const Scene& scene_;
    const TraceScene& trace_scene_;
    PathSettings settings_;
    LightPlan plan_;
    LightSampler light_sampler_;
    Openings openings_;
    std::vector<uint32_t> opening_lights_;  ///< of `openings_`: indices in the scene
    const RadianceCache* cache_ = nullptr;
    std::vector<Light> baked_lights_;
    std::vector<uint32_t> layer_of_baked_light_;
};

}  // namespace tetralight
