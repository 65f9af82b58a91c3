// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/preview_lightmaps.h>

#include <algorithm>
#include <optional>
#include <vector>

#include <tetralight/bake/lightmap/fill_texels.h>
#include <tetralight/bake/parallel.h>
#include <tetralight/bake/texel_light.h>
#include <tetralight/base/half.h>

namespace tetralight {
namespace {

class PreviewWriter {
  public:
    PreviewWriter(const Scene& scene, const PreparedLightmaps& prepared, const TexelBake& bake,
                  const RadianceCache* cache)
        : prepared_(prepared), bake_(bake), light_(prepared.texels.validity.size()) {
        if (cache != nullptr && holds_the_same_light(scene)) take_cached(scene, *cache);
        take_sampled();
    }

    Lightmaps run() {
        const Lightmaps& source = prepared_.lightmaps;
        maps_.info = source.info;
        maps_.info.scale = lightmap_scale(largest());
        maps_.rectangles = source.rectangles;
        maps_.instance_names = source.instance_names;
        maps_.meshes = source.meshes;
        maps_.corner_uvs = source.corner_uvs;
        maps_.metadata = R"({"is_preview":true})";
        maps_.irradiance.resize(maps_.view().texel_count());
        parallel_for(maps_.rectangles.size(), prepared_.settings.bake.thread_count,
                     [&](size_t instance) { write(instance); });
        return std::move(maps_);
    }

  private:
    using Light = std::optional<glm::vec3>;

    /// The cache also has the direct light of mixed lights; that of suns is kept apart.
    [[nodiscard]] bool holds_the_same_light(const Scene& scene) const {
        for (size_t i = 0; i < scene.lights.size(); ++i) {
            if (is_mixed(scene, i) && scene.lights[i].type != LightType::Directional) return false;
        }
        return true;
    }

    [[nodiscard]] bool is_mixed(const Scene& scene, size_t light) const {
        return prepared_.settings.bake.plan.mode_of(scene, light) == LightMode::Mixed;
    }

    void take_cached(const Scene& scene, const RadianceCache& cache) {
        if (cache.irradiance.size() != light_.size()) return;
        bool has_mixed = false;
        for (size_t i = 0; i < scene.lights.size(); ++i) has_mixed |= is_mixed(scene, i);
        for (const uint32_t texel : prepared_.baked) {
            const RadianceCache::Irradiance& light = cache.irradiance[texel];
            const glm::vec3 sun = has_mixed ? glm::vec3(0.0f) : light.sun;
            light_[texel] = sun + light.sources + light.reflected;
        }
    }

    void take_sampled() {
        for (size_t i = 0; i < bake_.accumulators.size(); ++i) {
            const ProbeAccumulator& sums = bake_.accumulators[i];
            if (sums.sample_count == 0) continue;
            const auto count = static_cast<double>(sums.sample_count);
            light_[prepared_.baked[bake_.range[i]]] =
                irradiance_on_normal(sums.radiance_sum[2] / count);
        }
    }

    [[nodiscard]] float largest() const {
        float largest = 0.0f;
        for (const Light& light : light_) {
            if (light) largest = std::max({largest, light->x, light->y, light->z});
        }
        return largest;
    }

    void write(size_t instance) {
        const LightmapRectangle& place = maps_.rectangles[instance];
        if (place.page == kNoIndex) return;
        const TexelMap& map = prepared_.maps[place.mesh];
        const Light* lights = light_.data() + prepared_.texels.first_texel[instance];
        std::vector<bool> has_light(map.texels.size()), is_covered(map.charts.size() + 1);
        std::vector<glm::vec3> values(map.charts.size() + 1);
        for (size_t i = 0; i < map.texels.size(); ++i) {
            has_light[i] = lights[i].has_value();
            if (!has_light[i]) continue;
            values[map.texels[i].index] = *lights[i];
            is_covered[map.texels[i].index] = true;
        }
        const TexelFill fill = make_texel_fill(map, has_light);
        fill.apply(values);
        for (const TexelFill::Step& step : fill.steps) is_covered[step.texel] = true;
        for (uint32_t texel = 0; texel < map.charts.size(); ++texel) {
            if (is_covered[texel])
                store(place, texel % map.width, texel / map.width, values[texel]);
        }
    }

    void store(const LightmapRectangle& place, uint32_t x, uint32_t y, glm::vec3 value) {
        IrradianceTexel& texel =
            maps_.irradiance[maps_.info.texel_index(place.page, place.x + x, place.y + y)];
        for (int i = 0; i < 3; ++i)
            texel.rgb[static_cast<size_t>(i)] =
                half_from_float_saturated(value[i] / maps_.info.scale);
        texel.coverage = kCovered;
    }

    const PreparedLightmaps& prepared_;
    const TexelBake& bake_;
    std::vector<Light> light_;  ///< one a texel
    Lightmaps maps_;
};

}  // namespace

Lightmaps preview_lightmaps(const Scene& scene, const PreparedLightmaps& prepared,
                            const TexelBake& bake, const RadianceCache* cache) {
    return PreviewWriter(scene, prepared, bake, cache).run();
}

}  // namespace tetralight
