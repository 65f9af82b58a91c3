// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <vector>

#include <tetralight/bake/occlusion.h>
#include <tetralight/base/half.h>
#include <tetralight/bench/lightmap.h>
#include <tetralight/pipeline/bake_lightmaps.h>

namespace tetralight::bench {
namespace {

/// Coarse texels with few samples: what is compared does not depend on either.
BakeLightmapsSettings coarse() {
    BakeLightmapsSettings settings;
    settings.layout.texels_per_meter = 1.0;
    settings.layout.page_size = 1024;
    settings.bake.sample_count = 64;
    return settings;
}

/// With the brightest sun mixed and half a degree wide.
Scene with_mixed_sun(Scene scene) {
    for (Light& light : scene.lights) {
        if (light.type != LightType::Directional) continue;
        light.mode = LightMode::Mixed;
        light.radius = 0.0087f;
    }
    return scene;
}

float value_of(uint16_t half, float scale) {
    return float_from_half(half) * scale;
}

}  // namespace

void bench_shadow_mask(const Scene& scene, const std::string& name) {
    const Scene mixed = with_mixed_sun(scene);
    BakeLightmapsSettings settings = coarse();
    settings.lighting.mixed_lighting = MixedLighting::Shadowmask;
    settings.bake.sample_count = 1;
    const auto baked = bake_lightmaps(mixed, settings);
    const auto prepared = prepare_lightmaps(mixed, settings);
    require(baked && prepared, "lightmaps");
    const auto traced = TraceScene::make_static(mixed);
    require(bool(traced), "scene");
    const PathTracer tracer(mixed, *traced, {});
    std::vector<Light> lights;
    for (const Light& light : mixed.lights) lights.push_back(traced->render_from_world(light));
    double worst = 0.0;
    size_t penumbra = 0;
    const std::vector<size_t> indices = prepared->page_texels();
    for (size_t i = 0; i < indices.size(); ++i) {
        const uint32_t texel = prepared->baked[i];
        const OcclusionLights& channels = prepared->occlusion_lights[i];
        if (channels[0] == kNoIndex) continue;
        const TexelSurface surface = prepared->texels.view()[texel];
        const glm::vec3 position = traced->render_from_world(prepared->texels.positions[texel]);
        double probes = 0.0, variance = 0.0;
        for (const glm::vec3& origin : surface.origins) {
            const double seen =
                double{light_visibility(tracer, lights[channels[0]], position + origin, texel)};
            probes += seen;
            variance += seen * (1.0 - seen) / kOcclusionRayCount;
        }
        const auto places = static_cast<double>(surface.origins.size());
        probes /= places;
        // Texels share the rays of one probe among their places.
        const double sigma = std::sqrt(variance / places * (1.0 + 1.0 / places));
        const double mask = baked->lightmaps.shadow_mask[indices[i]][0] / 255.0;
        worst = std::max(worst, std::abs(mask - probes) / std::max(4.0 * sigma, 1.0 / 255.0));
        penumbra += mask > 0.02 && mask < 0.98;
    }
    report("lightmap.shadowmask." + name, worst,
           "largest difference to probes at the same places / max(4 sigma, 1/255)");
    report("lightmap.shadowmask_penumbra." + name, static_cast<double>(penumbra),
           "texels that see a part of the sun");
}

void bench_lightmap_layers(const Scene& scene, const std::string& name) {
    BakeLightmapsSettings settings = coarse();
    const auto whole = bake_lightmaps(scene, settings);
    settings.lighting.layers = {"sun", "sky", "emission"};
    const auto layered = bake_lightmaps(scene, settings);
    require(whole && layered, "lightmaps");
    const Lightmaps &a = whole->lightmaps, &b = layered->lightmaps;
    double unlayered = 0.0, sums = 0.0, brightest = 0.0;
    for (size_t i = 0; i < a.irradiance.size(); ++i) {
        for (size_t channel = 0; channel < 3; ++channel) {
            const double light = double{value_of(a.irradiance[i].rgb[channel], a.info.scale)};
            const double total = double{value_of(b.irradiance[i].rgb[channel], b.info.scale)};
            double sum = 0.0;
            for (size_t layer = 0; layer < b.layers.size(); ++layer) {
                const LayerTexel& part = b.layer_irradiance[layer * b.irradiance.size() + i];
                sum += double{value_of(part.rgb[channel], b.layers[layer].scale)};
            }
            brightest = std::max(brightest, light);
            unlayered = std::max(unlayered, std::abs(total - light));
            sums = std::max(sums, std::abs(sum - light));
        }
    }
    report("lightmap.layers." + name, sums / brightest,
           "largest difference of the sum of layers to the light without layers / brightest");
    report("lightmap.layers_total." + name, unlayered / brightest,
           "the same of the light with layers");
}

}  // namespace tetralight::bench
