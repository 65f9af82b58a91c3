// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lightmap/make_radiance_cache.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include <tetralight/bake/lights/scene_openings.h>
#include <tetralight/bake/parallel.h>
#include <tetralight/bake/path_tracer.h>
#include <tetralight/bake/probe_estimator.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/round_plan.h>
#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/bake/texel_light.h>

namespace tetralight {
namespace {

/// Texels that a thread takes at once.
constexpr size_t kTexelsAtOnce = 64;

/// The direct light of all lights that the bake includes. The plan's layers, then those of
/// directional lights, the last for the lights that have no layer.
LightPlan direct_plan(const Scene& scene, const LightPlan& plan) {
    LightPlan direct;
    direct.layer_of_material = plan.layer_of_material;
    direct.layer_of_sky = plan.layer_of_sky;
    direct.layer_count = 2 * plan.layer_count + 1;
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const bool is_baked = scene.lights[i].mode != LightMode::Realtime;
        direct.light_modes.push_back(is_baked ? LightMode::Baked : LightMode::Realtime);
        uint32_t layer = plan.layer_of(plan.layer_of_light, i);
        if (scene.lights[i].type == LightType::Directional)
            layer = plan.layer_count + std::min(layer, plan.layer_count);
        direct.layer_of_light.push_back(layer);
    }
    return direct;
}

/// The irradiance of one layer in `ProbeEstimate::light_groups`.
glm::vec3 layer_irradiance(const ProbeEstimate& estimate, size_t layer) {
    const float* third = estimate.light_groups.data() + layer * LightGroupLayout::kLayerSize + 6;
    return irradiance_on_normal({third[0], third[1], third[2]});
}

glm::vec3 irradiance(const ProbeEstimate& estimate) {
    return irradiance_on_normal(glm::dvec3(estimate.radiance.coefficients[2]));
}

class CacheMaker {
  public:
    CacheMaker(const Scene& scene, const TraceScene& trace_scene, const LightmapLayout& layout,
               std::span<const TexelMap> maps, const LightmapTexels& texels,
               const BakeSettings& settings, const BakeCallback& callback)
        : scene_(scene),
          trace_scene_(trace_scene),
          layout_(layout),
          maps_(maps),
          texels_(texels),
          settings_(settings),
          progress_(callback, texel_count()) {}

    Result<RadianceCache> run(const RadianceCacheSettings& cache_settings) {
        cache_ = empty_radiance_cache(scene_, layout_, maps_, texels_);
        trust_texels();
        cache_.layer_count = settings_.plan.layer_count;
        cache_.irradiance.resize(texel_count());
        cache_.layer_irradiance.resize(texel_count() * cache_.layer_count);
        std::vector<Opening> openings = openings_of(scene_, trace_scene_);
        add_direct(cache_settings.direct_sample_count);
        add_reflected(cache_settings.path_count, std::move(openings));
        if (progress_.is_cancelled()) return Error{ErrorCode::Cancelled, "cancelled"};
        return std::move(cache_);
    }

  private:
    /// The independent random decisions of a texel.
    enum class Purpose : uint32_t { Direct, Reflected };

    [[nodiscard]] size_t texel_count() const { return texels_.positions.size(); }

    template <class Work>
    void for_each_instance(const Work& work) const {
        parallel_for(layout_.places.size(), settings_.thread_count, [&](size_t i) {
            if (layout_.places[i].has_lightmap()) work(static_cast<uint32_t>(i));
        });
    }

    void trust_texels() {
        std::vector<std::atomic<bool>> is_crossed(texel_count());
        for_each_instance([&](uint32_t instance) { find_walls(instance, is_crossed); });
        for (size_t i = 0; i < texel_count(); ++i)
            cache_.is_trusted.push_back(texels_.is_valid(i) && !is_crossed[i]);
    }

    /// Marks texels that lost a place to a wall, and those with a wall between them.
    void find_walls(uint32_t instance, std::vector<std::atomic<bool>>& is_crossed) const {
        const TexelMap& map = maps_[layout_.places[instance].packing];
        const RadianceCache::Map& places = cache_.maps[layout_.places[instance].packing];
        const uint32_t first = texels_.first_texel[instance];
        for (uint32_t i = 0; i < map.texels.size(); ++i) {
            const uint32_t index = map.texels[i].index;
            const size_t place_count = std::max<size_t>(1, map.samples(map.texels[i]).size());
            if (texels_.surfaces[first + i].origin_count < place_count)
                is_crossed[first + i] = true;
            const uint32_t x = index % map.width, y = index / map.width;
            constexpr std::array<glm::ivec2, 4> kSteps = {{{1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
            for (const glm::ivec2 step : kSteps) {
                if ((step.x < 0 && x == 0) || (step.x > 0 && x + 1 == map.width)) continue;
                const size_t beside = size_t{index} + static_cast<size_t>(step.y) * map.width +
                                      static_cast<size_t>(step.x);
                if (y + 1 == map.height && step.y > 0) continue;
                if (map.charts[beside] != map.charts[index]) continue;
                const uint32_t other = places.texels[beside];
                if (other == kNoIndex || !has_wall(instance, first + i, first + other)) continue;
                is_crossed[first + i] = is_crossed[first + other] = true;
            }
        }
    }

    /// True if something stands between two texels that are side by side.
    [[nodiscard]] bool has_wall(uint32_t instance, uint32_t a, uint32_t b) const {
        if (!texels_.is_valid(a) || !texels_.is_valid(b)) return false;
        const float size = cache_.instances[instance].texel_size;
        const glm::vec3 from = raised(a, size), to = raised(b, size);
        if (glm::distance(from, to) > 3.0f * size) return false;
        return trace_scene_.occluded({from, to - from, 1.0f});
    }

    /// A place of a texel, above curved surfaces, and below the top of the lowest wall.
    [[nodiscard]] glm::vec3 raised(uint32_t texel, float size) const {
        const TexelSurface surface = texels_.view()[texel];
        return trace_scene_.render_from_world(texels_.positions[texel]) + surface.origins[0] +
               0.1f * size * surface.normal;
    }

    /// Samples all texels: `use(texel, estimate)`.
    template <class Use>
    void sample(const PathTracer& tracer, Purpose purpose, uint32_t sample_count, const Use& use) {
        const size_t count = texel_count();
        parallel_for(
            (count + kTexelsAtOnce - 1) / kTexelsAtOnce, settings_.thread_count, [&](size_t k) {
                for (size_t i = k * kTexelsAtOnce; i < std::min(count, (k + 1) * kTexelsAtOnce);
                     ++i) {
                    if (!texels_.is_valid(i) || progress_.is_cancelled()) continue;
                    const glm::dvec3& position = texels_.positions[i];
                    const uint64_t key = estimate_key(
                        probe_key(settings_.seed + static_cast<uint64_t>(purpose) + 1, position), 0,
                        0);
                    const ProbeEstimate estimate =
                        estimate_texel(tracer, trace_scene_.render_from_world(position),
                                       texels_.view()[i], key, sample_count);
                    use(i, estimate);
                    progress_.add_rays(estimate.ray_count);
                }
            });
    }

    void add_direct(uint32_t sample_count) {
        const PathTracer tracer(scene_, trace_scene_, {.bounces = 0},
                                direct_plan(scene_, settings_.plan));
        const size_t layers = cache_.layer_count;
        sample(tracer, Purpose::Direct, sample_count, [&](size_t i, const ProbeEstimate& estimate) {
            RadianceCache::Irradiance& total = cache_.irradiance[i];
            for (size_t layer = 0; layer <= layers; ++layer)
                total.sun += layer_irradiance(estimate, layers + layer);
            total.sources = glm::max(irradiance(estimate) - total.sun, 0.0f);
            for (size_t layer = 0; layer < layers; ++layer) {
                cache_.layer_irradiance[i * layers + layer] = {
                    layer_irradiance(estimate, layers + layer), layer_irradiance(estimate, layer)};
            }
        });
    }

    void add_reflected(uint32_t path_count, std::vector<Opening> openings) {
        const PathTracer tracer(scene_, trace_scene_, {.is_reflected_only = true}, settings_.plan,
                                std::move(openings), &cache_);
        const size_t layers = cache_.layer_count;
        std::vector<glm::vec3> total(texel_count()), by_layer(texel_count() * layers);
        sample(tracer, Purpose::Reflected, path_count,
               [&](size_t i, const ProbeEstimate& estimate) {
                   total[i] = irradiance(estimate);
                   for (size_t layer = 0; layer < layers; ++layer)
                       by_layer[i * layers + layer] = layer_irradiance(estimate, layer);
               });
        for (size_t i = 0; i < total.size(); ++i) cache_.irradiance[i].reflected = total[i];
        for (size_t i = 0; i < by_layer.size(); ++i)
            cache_.layer_irradiance[i].reflected = by_layer[i];
        cache_.has_reflected = true;
    }

    const Scene& scene_;
    const TraceScene& trace_scene_;
    const LightmapLayout& layout_;
    std::span<const TexelMap> maps_;
    const LightmapTexels& texels_;
    const BakeSettings& settings_;
    ProgressReporter progress_;
    RadianceCache cache_;
};

}  // namespace

RadianceCache empty_radiance_cache(const Scene& scene, const LightmapLayout& layout,
                                   std::span<const TexelMap> maps, const LightmapTexels& texels) {
    RadianceCache cache;
    for (size_t i = 0; i < maps.size(); ++i) {
        const TexelMap& map = maps[i];
        RadianceCache::Map& added = cache.maps.emplace_back();
        added.width = map.width;
        added.corner_uvs = layout.packings[i].charts.corner_uvs;
        added.texels.assign(map.charts.size(), kNoIndex);
        for (uint32_t k = 0; k < map.texels.size(); ++k) added.texels[map.texels[k].index] = k;
    }
    for (size_t i = 0; i < layout.places.size(); ++i) {
        const double density = layout.texels_per_meter * double{scene.instances[i].lightmap.scale};
        cache.instances.push_back(
            {layout.places[i].packing, texels.first_texel[i], static_cast<float>(1.0 / density)});
    }
    return cache;
}

Result<RadianceCache> make_radiance_cache(const Scene& scene, const LightmapLayout& layout,
                                          std::span<const TexelMap> maps,
                                          const LightmapTexels& texels,
                                          const BakeSettings& settings,
                                          const RadianceCacheSettings& cache_settings,
                                          const BakeCallback& callback) {
    const auto trace_scene = TraceScene::make_static(scene, settings.surfaces);
    if (!trace_scene) return trace_scene.error();
    return CacheMaker(scene, *trace_scene, layout, maps, texels, settings, callback)
        .run(cache_settings);
}

}  // namespace tetralight
