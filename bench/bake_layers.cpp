// SPDX-License-Identifier: Apache-2.0
// Errors of the layers of a bake, each alone, as a volume shows them whose other layers are off.
#include <algorithm>
#include <cmath>

#include <tetralight/bake/bake_accumulators.h>
#include <tetralight/bake/bake_probes.h>
#include <tetralight/bench/bake_errors.h>
#include <tetralight/bench/bake_scenes.h>
#include <tetralight/pipeline/lighting_plan.h>

namespace tetralight::bench {
namespace {

/// The light of one bake, by layer and probe.
std::vector<std::vector<RadianceSh>> bake_layers(const BakeSubject& subject,
                                                 const LightPlan& plan) {
    BakeSettings settings = with_default_target({});
    settings.plan = plan;
    const LightGroupLayout layout(plan);
    std::vector<ProbeAccumulator> accumulators(subject.probes.size());
    std::vector<double> rows(layout.size() * subject.probes.size());
    require(bool(bake_accumulators(subject.scene, {subject.probes}, settings, accumulators, {},
                                   {.rows = rows})),
            "bake");
    std::vector<std::vector<RadianceSh>> light(plan.layer_count);
    for (size_t i = 0; i < light.size() * accumulators.size(); ++i) {
        const size_t layer = i / accumulators.size(), probe = i % accumulators.size();
        const double* sums = &rows[probe * layout.size() + layer * LightGroupLayout::kLayerSize];
        RadianceSh& radiance = light[layer].emplace_back();
        for (size_t k = 0; k < LightGroupLayout::kLayerSize; ++k) {
            const double mean = sums[k] / static_cast<double>(accumulators[probe].sample_count);
            radiance.coefficients[k / 3][static_cast<int>(k % 3)] = static_cast<float>(mean);
        }
    }
    return light;
}

/// A scene that has the light of one layer only.
Scene lit_by(const Scene& scene, const std::string& layer) {
    Scene alone = scene;
    if (layer != "sun") alone.lights.clear(), alone.light_names.clear();
    if (layer != "sky") alone.environment = {};
    for (Material& material : alone.materials) {
        if (layer != "emission") material.emission = glm::vec3(0.0f);
    }
    return alone;
}

/// A bake of the scene as it is, at half the default error.
std::vector<RadianceSh> bake_alone(const Scene& scene, const BakeSubject& subject) {
    BakeSettings settings = with_default_target({});
    settings.target_error *= 0.5;
    settings.max_sample_count *= 4;
    settings.seed = 1000;
    const auto baked = bake_probes(scene, subject.probes, settings);
    require(bool(baked), "bake");
    return baked->radiance;
}

}  // namespace

void bench_bake_layers(const BakeSubject& all, const Options& options) {
    BakeSubject subject = all;
    if (options.is_quick) subject.probes = some_probes(all);
    const std::vector<std::string> layers{"sun", "sky", "emission"};
    const auto lighting = plan_lighting(subject.scene, {MixedLighting::Indirect, layers});
    require(bool(lighting), "layers");
    const auto light = bake_layers(subject, lighting->bake);
    for (uint32_t layer = 0; layer < layers.size(); ++layer) {
        const auto exact = bake_alone(lit_by(subject.scene, layers[layer]), subject);
        double mean = 0.0;
        for (const RadianceSh& radiance : exact) mean += mean_irradiance(radiance);
        mean /= static_cast<double>(exact.size());
        std::vector<double> errors;
        for (size_t i = 0; i < exact.size(); ++i) {
            if (mean_irradiance(exact[i]) < 0.01 * mean) continue;
            errors.push_back(100.0 * relative_rmse(light[layer][i], exact[i]));
        }
        require(!errors.empty(), "light of layer " + layers[layer]);
        std::ranges::sort(errors);
        const std::string name = layers[layer] + "." + subject.name;
        report("bake.layer_error." + name, median(errors), "%");
        report("bake.layer_error.p95." + name, errors[(errors.size() - 1) * 95 / 100], "%");
    }
}

}  // namespace tetralight::bench
