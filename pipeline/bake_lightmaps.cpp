// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/bake_lightmaps.h>

#include <algorithm>
#include <utility>

#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/round_plan.h>
#include <tetralight/base/stopwatch.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/pipeline/stored_bake.h>

namespace tetralight {
namespace {

/// Returns not_found if a name of `only` is not that of an object with a lightmap.
Status check_only(const Scene& scene, const BakeLightmapsSettings& settings) {
    for (const std::string& name : settings.only) {
        const bool is_known = std::ranges::any_of(scene.instances, [&](const auto& instance) {
            return instance.name == name && takes_lightmap(scene, instance);
        });
        if (is_known) continue;
        return Error{ErrorCode::NotFound, "only", name,
                     str_cat("only: no object \"", name, "\" of the scene takes a lightmap")};
    }
    return Ok{};
}

Status check_layers(const LightingSettings& lighting) {
    if (std::ranges::find(lighting.layers, "transfer") == lighting.layers.end()) return Ok{};
    return Error{ErrorCode::Unsupported, "layers", "transfer",
                 "layers: lightmaps have no transfer of distant light"};
}

bool is_baked(const Scene& scene, uint32_t instance, const std::vector<std::string>& only) {
    return only.empty() || std::ranges::find(only, scene.instances[instance].name) != only.end();
}

/// Selects the texels that are baked.
void select_texels(const Scene& scene, PreparedLightmaps& prepared) {
    const LightmapTexels& texels = prepared.texels;
    for (uint32_t instance = 0; instance < scene.instances.size(); ++instance) {
        if (!is_baked(scene, instance, prepared.settings.only)) continue;
        for (uint32_t i = texels.first_texel[instance]; i < texels.first_texel[instance + 1]; ++i) {
            if (!texels.is_valid(i)) continue;
            prepared.baked.push_back(i);
            prepared.positions.push_back(texels.positions[i]);
            prepared.surfaces.push_back(texels.surfaces[i]);
        }
    }
}

size_t chart_count(const LightmapPacking& packing) {
    const auto& charts = packing.triangle_charts;
    return charts.empty() ? 0 : size_t{*std::ranges::max_element(charts)} + 1;
}

void count_texels(PreparedLightmaps& prepared) {
    LightmapReport& report = prepared.report;
    report.texel_count = prepared.texels.positions.size();
    for (size_t i = 0; i < report.texel_count; ++i) {
        report.invalid_count += !prepared.texels.is_valid(i);
    }
    for (const LightmapPacking& packing : prepared.layout.packings) {
        report.chart_count += chart_count(packing);
    }
    report.baked_count = prepared.baked.size();
}

}  // namespace

Result<PreparedLightmaps> prepare_lightmaps(const Scene& scene,
                                            const BakeLightmapsSettings& settings) {
    if (auto status = RoundPlan::check(settings.bake); !status) return status.error();
    if (auto status = check_layers(settings.lighting); !status) return status.error();
    if (auto status = check_only(scene, settings); !status) return status.error();
    auto plan = plan_lighting(scene, settings.lighting);
    if (!plan) return plan.error();
    PreparedLightmaps prepared;
    prepared.settings = settings;
    prepared.settings.bake.plan = plan->bake;
    prepared.settings.bake.plan.has_occlusion = false;
    prepared.layer_names = plan->layer_names;
    prepared.report.warnings = plan->warnings;
    Stopwatch watch;
    auto layout = make_lightmap_layout(scene, settings.layout);
    if (!layout) return layout.error();
    if (layout->page_count == 0) {
        return Error{ErrorCode::InvalidArgument, "the scene has no object that takes a lightmap"};
    }
    prepared.layout = std::move(*layout);
    auto& warnings = prepared.report.warnings;
    warnings.insert(warnings.end(), prepared.layout.warnings.begin(),
                    prepared.layout.warnings.end());
    prepared.report.layout_seconds = watch.lap();
    const auto traced = TraceScene::make_static(scene, settings.bake.surfaces);
    if (!traced) return traced.error();
    prepared.maps = make_texel_maps(scene, prepared.layout, settings.texels);
    auto texels =
        make_lightmap_texels(scene, *traced, prepared.layout, prepared.maps, settings.texels);
    if (!texels) return texels.error();
    prepared.texels = std::move(*texels);
    select_texels(scene, prepared);
    count_texels(prepared);
    prepared.report.texel_seconds = watch.lap();
    return prepared;
}

Result<TexelBake> bake_texels(const Scene& scene, const PreparedLightmaps& prepared,
                              const BakeStorage& storage, const BakeCallback& callback) {
    const BakeSettings& settings = prepared.settings.bake;
    TexelBake bake;
    bake.accumulators.resize(prepared.baked.size());
    bake.rows.resize(prepared.baked.size() * LightGroupLayout(settings.plan).size());
    auto stored = bake_with_stores(scene, prepared.places(), settings, storage,
                                   {bake.accumulators, {bake.rows, {}}}, callback);
    if (!stored) return stored.error();
    bake.stored = std::move(*stored);
    return bake;
}

Result<BakedLightmaps> bake_lightmaps(const Scene& scene, const BakeLightmapsSettings& settings,
                                      const BakeStorage& storage, const BakeCallback& callback) {
    auto prepared = prepare_lightmaps(scene, settings);
    if (!prepared) return prepared.error();
    const Stopwatch watch;
    const auto bake = bake_texels(scene, *prepared, storage, callback);
    if (!bake) return bake.error();
    prepared->report.bake_seconds = watch.seconds();
    return finish_lightmaps(scene, std::move(*prepared), *bake);
}

}  // namespace tetralight
