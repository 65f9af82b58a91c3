// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/bake_lightmaps.h>

#include <algorithm>
#include <functional>
#include <span>
#include <utility>

#include <tetralight/bake/lightmap/mapped_texels.h>
#include <tetralight/bake/occlusion_channels.h>
#include <tetralight/bake/path_tracer.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/round_plan.h>
#include <tetralight/bake/scene/mapped_normal.h>
#include <tetralight/base/process/memory.h>
#include <tetralight/base/stopwatch.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/pipeline/bake_key.h>
#include <tetralight/pipeline/lightmap_metadata.h>
#include <tetralight/pipeline/lightmap_scene.h>
#include <tetralight/pipeline/preview_lightmaps.h>
#include <tetralight/pipeline/stored_bake.h>
#include <tetralight/pipeline/stored_cache.h>
#include <tetralight/pipeline/texel_lights.h>

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
                     str_cat("no object \"", name, "\" of the scene takes a lightmap")};
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

/// The plan of lights for texels. Subtractive: static objects take all light of mixed lights from
/// their texels.
LightPlan texel_plan(const LightingPlan& plan, const BakeLightmapsSettings& settings) {
    const MixedLighting mode = settings.lighting.mixed_lighting;
    LightPlan texels = plan.bake;
    texels.has_occlusion = mode == MixedLighting::Shadowmask;
    texels.ambient_occlusion_distance = settings.ambient_occlusion_distance;
    if (mode != MixedLighting::Subtractive) return texels;
    for (LightMode& light : texels.light_modes) {
        if (light == LightMode::Mixed) light = LightMode::Baked;
    }
    return texels;
}

/// The lights whose visibility each baked texel stores.
void store_occlusion_lights(const LightingPlan& plan, PreparedLightmaps& prepared) {
    if (!prepared.has_shadow_mask()) return;
    const std::vector<uint32_t> channels = channels_of(plan.light_states);
    for (const glm::dvec3& position : prepared.positions) {
        prepared.occlusion_lights.push_back(occlusion_lights_at(position, plan.lights, channels));
    }
}

/// What the pages hold beside texels.
void describe(const Scene& scene, const LightingPlan& plan, PreparedLightmaps& prepared) {
    const LightmapLayout& layout = prepared.layout;
    const auto& layer_names = plan.layer_names;
    Lightmaps& maps = prepared.lightmaps;
    maps.info.mixed_lighting = prepared.settings.lighting.mixed_lighting;
    maps.info.ambient_occlusion_distance = prepared.settings.ambient_occlusion_distance;
    maps.info.page_size = layout.page_size;
    maps.info.page_count = layout.page_count;
    maps.info.texels_per_meter = static_cast<float>(layout.texels_per_meter);
    for (const LightmapPacking& packing : layout.packings) {
        maps.meshes.push_back({geometry_key(scene.meshes[packing.mesh]),
                               static_cast<uint32_t>(maps.corner_uvs.size()),
                               static_cast<uint32_t>(packing.triangle_charts.size()),
                               {}});
        const std::vector<glm::vec2> uvs = unit_uvs(packing.charts);
        maps.corner_uvs.insert(maps.corner_uvs.end(), uvs.begin(), uvs.end());
    }
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        maps.rectangles.push_back(rectangle_of(layout, layout.places[i]));
        std::string name = scene.instances[i].name;
        std::ranges::replace(name, '\n', ' ');
        maps.instance_names += name + "\n";
    }
    maps.layers.resize(layer_names.size());
    for (const std::string& name : layer_names) maps.layer_names += name + "\n";
    maps.metadata = lightmap_metadata(scene, plan, prepared.settings);
}

/// Which instances have baked texels: not those that `only` leaves out, or that are inside
/// geometry.
std::vector<bool> lit_instances(const PreparedLightmaps& prepared) {
    const auto& first_texel = prepared.texels.first_texel;
    std::vector<bool> is_lit;
    auto next = prepared.baked.begin();
    for (size_t instance = 0; instance + 1 < first_texel.size(); ++instance) {
        const auto end = std::lower_bound(next, prepared.baked.end(), first_texel[instance + 1]);
        is_lit.push_back(next != end);
        next = end;
    }
    return is_lit;
}

/// Seams between charts that are stitched.
std::vector<Seam> seams_of(const Scene& scene, const PreparedLightmaps& prepared,
                           std::vector<bool> joins) {
    for (size_t i = 0; i < scene.instances.size(); ++i)
        joins[i] = joins[i] && scene.instances[i].lightmap.stitches_seams;
    return find_seams(scene, prepared.layout, joins);
}

/// Warns of objects that take a lightmap and have no light in it.
void warn_of_dark_objects(const Scene& scene, const std::vector<bool>& is_lit,
                          PreparedLightmaps& prepared) {
    constexpr size_t kNamed = 3;
    std::string names;
    size_t count = 0;
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const bool is_asked =
            takes_lightmap(scene, scene.instances[i]) && is_baked(scene, i, prepared.settings.only);
        if (!is_asked || is_lit[i]) continue;
        if (++count <= kNamed)
            names += str_cat(count == 1 ? "" : ", ", "\"", scene.instances[i].name, "\"");
    }
    if (count == 0) return;
    if (count > kNamed) names += str_cat(" and ", count - kNamed, " more");
    prepared.report.warnings.push_back(
        count == 1 ? str_cat("no light was found for 1 object, which stays black: all its texels "
                             "are inside geometry, or its surface has no area (",
                             names, ")")
                   : str_cat("no light was found for ", count,
                             " objects, which stay black: all their texels are inside geometry, or "
                             "their surfaces have no area (",
                             names, ")"));
}

/// Warns of baked objects whose normal maps cannot be in their texels.
void warn_of_lost_normal_maps(const Scene& scene, PreparedLightmaps& prepared) {
    const std::string* first = nullptr;
    size_t count = 0;
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const MeshInstance& instance = scene.instances[i];
        const bool is_asked =
            takes_lightmap(scene, instance) && is_baked(scene, i, prepared.settings.only);
        if (!is_asked || !lacks_normal_map_uvs(scene, scene.meshes[instance.mesh])) continue;
        if (++count == 1) first = &instance.name;
    }
    if (count == 0) return;
    prepared.report.warnings.push_back(
        count == 1 ? str_cat("the normal map of 1 object is not baked: its mesh has no texture "
                             "coordinates for it (\"",
                             *first, "\")")
                   : str_cat("the normal maps of ", count,
                             " objects are not baked: their meshes have no texture coordinates for "
                             "them (the first is \"",
                             *first, "\")"));
}

/// Returns out_of_resources if the pages do not fit into the free memory.
Status check_memory(const LightmapLayout& layout, size_t layer_count, bool has_cache,
                    bool is_filtered) {
    constexpr uint64_t kLayerBytes = sizeof(LayerTexel) + sizeof(LightmapTexel);
    // Validity and error; what stitching needs; and the bytes of the file.
    // With what can be there of occlusion.
    constexpr uint64_t kTexelBytes =
        2 * (sizeof(IrradianceTexel) + sizeof(LightmapTexel) + 3 + sizeof(ShadowMaskTexel) + 1) + 5;
    const uint64_t texels = uint64_t{layout.page_size} * layout.page_size * layout.page_count;
    // Of cached light, and the reflected light while it is sampled.
    constexpr uint64_t kCacheBytes = sizeof(RadianceCache::Irradiance) + sizeof(glm::vec3);
    const uint64_t cache_bytes =
        has_cache ? kCacheBytes * (1 + layer_count) + 2 * sizeof(uint32_t) : 0;
    const uint64_t bytes = texels * (kTexelBytes + 2 * kLayerBytes * layer_count + cache_bytes +
                                     TexelLights::texel_bytes(layer_count, is_filtered));
    const uint64_t free = free_memory();
    if (bytes <= free) return Ok{};
    return Error{ErrorCode::OutOfResources, "page_size", str_cat(layout.page_size),
                 str_cat(layout.page_count, " pages of ", layout.page_size, " x ", layout.page_size,
                         " texels need about ", gigabytes(bytes), " of memory, ", gigabytes(free),
                         " are free; use smaller pages or fewer texels per metre")};
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
    report.seam_count = prepared.seams.size();
}

}  // namespace

std::vector<size_t> PreparedLightmaps::page_texels() const {
    std::vector<size_t> indices;
    size_t instance = 0;
    for (const uint32_t texel : baked) {
        while (texel >= texels.first_texel[instance + 1]) ++instance;
        const LightmapRectangle& place = lightmaps.rectangles[instance];
        const TexelMap& map = maps[place.mesh];
        const uint32_t index = map.texels[texel - texels.first_texel[instance]].index;
        indices.push_back(lightmaps.info.texel_index(place.page, place.x + index % map.width,
                                                     place.y + index / map.width));
    }
    return indices;
}

std::span<const glm::vec3> TexelBake::mapped_normals_of(size_t texel) const {
    if (mapped_normals.empty()) return {};
    const auto mapped = std::span(mapped_normals).subspan(kMappedNormals * texel, kMappedNormals);
    const glm::vec3& own = normals[texel];
    const bool is_flat = std::ranges::all_of(mapped, [&](const glm::vec3& n) { return n == own; });
    return is_flat ? std::span<const glm::vec3>{} : mapped;
}

bool PreparedLightmaps::has_cache() const {
    const PathSettings paths{settings.bake.bounces, settings.bake.clamp};
    return !settings.is_exact && paths.traces_all_light();
}

Status check_lightmaps(const Scene& scene, const BakeLightmapsSettings& settings) {
    if (auto status = RoundPlan::check(settings.bake); !status) return status;
    if (auto status = check_layers(settings.lighting); !status) return status;
    if (auto status = check_only(scene, settings); !status) return status;
    const auto takes = [&](const auto& instance) { return takes_lightmap(scene, instance); };
    if (std::ranges::any_of(scene.instances, takes)) return Ok{};
    return Error{ErrorCode::InvalidArgument, "the scene has no object that takes a lightmap"};
}

Result<PreparedLightmaps> prepare_lightmaps(const Scene& scene,
                                            const BakeLightmapsSettings& settings) {
    if (auto status = check_lightmaps(scene, settings); !status) return status.error();
    auto plan = plan_lighting(scene, settings.lighting);
    if (!plan) return plan.error();
    PreparedLightmaps prepared;
    prepared.settings = settings;
    prepared.settings.bake.plan = texel_plan(*plan, settings);
    prepared.report.warnings = plan->warnings;
    Stopwatch watch;
    auto layout = make_lightmap_layout(scene, settings.layout);
    if (!layout) return layout.error();
    if (layout->page_count == 0) {
        return Error{ErrorCode::InvalidArgument, "the scene has no object that takes a lightmap"};
    }
    if (auto status = check_memory(*layout, plan->layer_names.size(), prepared.has_cache(),
                                   !settings.is_unfiltered);
        !status)
        return status.error();
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
    if (settings.has_normal_maps) {
        warn_of_lost_normal_maps(scene, prepared);
        prepared.mapped_normals = make_mapped_normals(scene, prepared.layout, prepared.maps,
                                                      prepared.texels, prepared.baked);
    }
    describe(scene, *plan, prepared);
    store_occlusion_lights(*plan, prepared);
    const std::vector<bool> is_lit = lit_instances(prepared);
    warn_of_dark_objects(scene, is_lit, prepared);
    prepared.seams = seams_of(scene, prepared, is_lit);
    prepared.key = lightmap_key(prepared);
    count_texels(prepared);
    prepared.report.texel_seconds = watch.lap();
    return prepared;
}

Result<TexelBake> bake_texel_range(const Scene& scene, const PreparedLightmaps& prepared,
                                   PlaceRange range, const BakeStorage& storage,
                                   const BakeCallback& callback, const LightmapPreview& preview) {
    if (auto status = check_range(range, {"texel", prepared.baked.size()}); !status)
        return status.error();
    const BakeSettings& settings = prepared.settings.bake;
    BakePlaces places = prepared.places();
    const auto positions = take(places.positions, range);
    const auto texels = take(places.surfaces.texels, range);
    places.positions = positions;
    places.surfaces.texels = texels;
    std::vector<OcclusionLights> occlusion_lights;
    if (!prepared.occlusion_lights.empty())
        occlusion_lights = take(std::span(prepared.occlusion_lights), range);
    TexelBake bake;
    bake.range = range;
    bake.accumulators.resize(range.count());
    bake.rows.resize(range.count() * LightGroupLayout(settings.plan).size());
    for (const TexelSurfaces::Texel& texel : places.surfaces.texels)
        bake.normals.push_back(texel.normal);
    if (!prepared.mapped_normals.empty()) {
        bake.mapped_normals = take(std::span(prepared.mapped_normals), range, kMappedNormals);
    }
    RadianceCache cache;
    BakeHooks hooks{.progress = callback, .preview_seconds = preview.seconds};
    if (prepared.has_cache()) {
        places.surfaces.cache = &cache;
        places.surfaces.cache_key = cache_key(prepared);
        hooks.begin = [&]() -> Status {
            const Stopwatch watch;
            auto made = stored_radiance_cache(scene, prepared, storage.cache, callback);
            if (!made) return made.error();
            cache = std::move(*made);
            bake.cache_seconds = watch.seconds();
            return Ok{};
        };
    }
    if (range.count() == 0 && hooks.begin && storage.cache != nullptr) {
        if (auto status = hooks.begin(); !status) return status.error();
    }
    if (preview.show) {
        hooks.preview = [&] {
            const bool has_cache = prepared.has_cache();
            preview.show(
                preview_lightmaps(scene, prepared, bake, has_cache ? &cache : nullptr).view());
        };
    }
    auto stored =
        bake_with_stores(scene, places, settings, storage,
                         {bake.accumulators, {bake.rows, occlusion_lights}}, std::move(hooks));
    if (!stored) return stored.error();
    bake.stored = std::move(*stored);
    return bake;
}

Result<TexelBake> bake_texels(const Scene& scene, const PreparedLightmaps& prepared,
                              const BakeStorage& storage, const BakeCallback& callback) {
    const auto count = static_cast<uint32_t>(prepared.baked.size());
    return bake_texel_range(scene, prepared, {0, count}, storage, callback);
}

void record_samples(PreparedLightmaps& prepared, const TexelBake& bake) {
    BakeSettings& settings = prepared.settings.bake;
    if (settings.time_budget_seconds == 0.0) return;
    const bool has_target = settings.target_error > 0.0 || settings.target_layer_error > 0.0;
    if (bake.stored.samples_in_time) {
        settings.max_sample_count = *bake.stored.samples_in_time;
    } else if (!has_target) {
        settings.max_sample_count = RoundPlan(settings).max_samples();
    }
    settings.time_budget_seconds = 0.0;
    set_recorded_samples(prepared.lightmaps.metadata, settings.max_sample_count);
    prepared.key = lightmap_key(prepared);
}

Result<BakedLightmaps> bake_lightmaps(const Scene& scene, const BakeLightmapsSettings& settings,
                                      const BakeStorage& storage, const BakeCallback& callback) {
    auto prepared = prepare_lightmaps(scene, settings);
    if (!prepared) return prepared.error();
    const Stopwatch watch;
    const auto bake = bake_texels(scene, *prepared, storage, callback);
    if (!bake) return bake.error();
    prepared->report.bake_seconds = watch.seconds();
    record_samples(*prepared, *bake);
    return finish_lightmaps(std::move(*prepared), *bake);
}

}  // namespace tetralight
