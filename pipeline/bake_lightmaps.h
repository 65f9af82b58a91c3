// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include <tetralight/bake/bake_accumulators.h>
#include <tetralight/bake/lightmap/lightmap_layout.h>
#include <tetralight/bake/lightmap/lightmap_texels.h>
#include <tetralight/bake/lightmap/seams.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/lightmap/lightmaps.h>
#include <tetralight/pipeline/lighting_plan.h>
#include <tetralight/pipeline/place_range.h>
#include <tetralight/pipeline/stored_bake.h>

// Bakes the lightmaps of a scene:
//
//     scene → prepare_lightmaps → bake_texels → finish_lightmaps → Lightmaps → write_lightmap_file
//
// Several machines can bake ranges of the texels (`bake_texel_range`), write them into parts
// (pipeline/lightmap_part.h) and join these (pipeline/merge_parts.h) to the same bytes.

namespace tetralight {

/// Samples of a texel's first round.
[[nodiscard]] inline BakeSettings texel_bake_settings() {
    BakeSettings settings;
    settings.sample_count = 128;
    return settings;
}

struct BakeLightmapsSettings {
    LightmapLayoutSettings layout;
    LightmapTexelSettings texels;
    /// Samples, errors and bounces of a texel, as those of a probe. The plan follows from
    /// `lighting`.
    BakeSettings bake = texel_bake_settings();
    /// Paths are traced to their ends. Else they end where they meet a texel whose light is known
    /// (`RadianceCache`), unless bounces or brightness are limited.
    bool is_exact = false;
    /// Texels have the light of their own samples only. Else they are filtered (`TexelLights`).
    bool is_unfiltered = false;
    /// `irradiance` is the mean over places of a texel on the normals of their normal maps
    /// (`make_mapped_normals`), for textures without directions. The scene has to be read with
    /// `NormalMaps::Read`.
    bool has_normal_maps = false;
    LightingSettings lighting{};
    /// Bakes `Lightmaps::ambient_occlusion` of surfaces nearer than this, metres. 0: no.
    float ambient_occlusion_distance = 0.0f;
    /// Names of objects: the texels of all others stay black. Empty: all objects.
    std::vector<std::string> only;
};

/// The settings of `tetralight lightmap` when neither samples, a target error nor a time budget is
/// given: rounds up to 16 384 samples per texel, until the standard error is at most 5 %.
[[nodiscard]] inline BakeSettings with_default_texel_target(BakeSettings settings) {
    settings.target_error = 0.05;
    settings.max_sample_count = 16'384;
    return settings;
}

/// Counts and times of a bake of lightmaps, for people.
struct LightmapReport {
    size_t texel_count = 0;    ///< that surfaces cover
    size_t invalid_count = 0;  ///< inside geometry: they have the light of other texels
    size_t chart_count = 0;    ///< of all packings
    size_t baked_count = 0;
    /// Edges at which charts of one surface meet, and the 99th percentile of the relative
    /// difference of the irradiance on both sides of them, as baked and as written.
    size_t seam_count = 0;
    float seam_difference_baked = 0.0f;
    float seam_difference = 0.0f;
    /// Samples of a texel.
    uint64_t min_samples = 0;
    uint64_t median_samples = 0;
    uint64_t max_samples = 0;
    /// Texels above the target error after all samples, and errors of lit texels.
    size_t over_target_count = 0;
    float median_error = 0.0f;
    float worst_error = 0.0f;
    uint64_t ray_count = 0;
    double layout_seconds = 0.0;
    double texel_seconds = 0.0;
    double bake_seconds = 0.0;
    double cache_seconds = 0.0;  ///< part of `bake_seconds`
    std::vector<std::string> warnings;
};

/// Lightmaps before their light is sampled: the same for each part of the bake.
struct PreparedLightmaps {
    BakeLightmapsSettings settings;  ///< `settings.bake.plan` is the plan for this scene
    LightmapLayout layout;
    std::vector<TexelMap> maps;
    LightmapTexels texels;
    /// The texels that are baked, in ascending order, and their places.
    std::vector<uint32_t> baked;
    std::vector<glm::dvec3> positions;
    std::vector<TexelSurfaces::Texel> surfaces;
    /// The lights of the channels of each baked texel's shadow mask; empty without one.
    std::vector<OcclusionLights> occlusion_lights;
    /// `kMappedNormals` of each texel, or none.
    std::vector<glm::vec3> mapped_normals;
    /// Complete but for texels: rectangles, UVs, layers and metadata.
    Lightmaps lightmaps;
    /// Between instances that have baked texels.
    std::vector<Seam> seams;
    /// Hash of all that the bytes of the baked lightmaps depend on (`lightmap_key`). Parts of one
    /// bake have the same key.
    uint64_t key = 0;
    LightmapReport report;

    [[nodiscard]] BakePlaces places() const { return {positions, {surfaces, texels.origins}}; }

    /// The index in the pages of each baked texel (`LightmapInfo::texel_index`).
    [[nodiscard]] std::vector<size_t> page_texels() const;

    /// True if paths end at a radiance cache.
    [[nodiscard]] bool has_cache() const;

    [[nodiscard]] bool has_shadow_mask() const {
        return lightmaps.info.mixed_lighting == MixedLighting::Shadowmask;
    }

    [[nodiscard]] bool has_ambient_occlusion() const {
        return lightmaps.info.ambient_occlusion_distance > 0.0f;
    }
};

/// The light of a range of the baked texels, one of each per texel.
struct TexelBake {
    PlaceRange range;  ///< of `PreparedLightmaps::baked`
    std::vector<ProbeAccumulator> accumulators;
    std::vector<double> rows;  ///< of `LightGroupLayout(settings.bake.plan)`
    std::vector<glm::vec3> normals;
    std::vector<glm::vec3> mapped_normals;  ///< of the range, as in `PreparedLightmaps`
    StoredBake stored;
    double cache_seconds = 0.0;  ///< 0 = no cache was made

    /// The normals that the irradiance of a texel is for. Empty: its own normal alone.
    [[nodiscard]] std::span<const glm::vec3> mapped_normals_of(size_t texel) const;
};

/// Returns the errors of `prepare_lightmaps` that need no layout.
[[nodiscard]] Status check_lightmaps(const Scene& scene, const BakeLightmapsSettings& settings);

/// Returns the errors of `make_lightmap_layout`, `make_lightmap_texels`, `plan_lighting` and
/// `TraceScene::make_static`; not_found (field "only") if no object has a name; unsupported (field
/// "layers") for the layer "transfer", which texels do not have; invalid_argument if no object of
/// the scene takes a lightmap.
[[nodiscard]] Result<PreparedLightmaps> prepare_lightmaps(const Scene& scene,
                                                          const BakeLightmapsSettings& settings);

/// A look at a bake that is under way.
struct LightmapPreview {
    /// Called with `preview_lightmaps` on the thread of the bake; empty: no previews. The light of
    /// the bake does not depend on it.
    std::function<void(const LightmapsView&)> show{};
    /// Time between two calls, or more: previews take at most a fiftieth of the time.
    double seconds = 5.0;
};

/// Samples the light of a range of the baked texels, after a radiance cache of the light of all
/// texels of the scene is made (`stored_radiance_cache`), if the settings ask for it and any sample
/// is missing, or if there is a store for it and the range is empty. Texels that a store has, from
/// an earlier bake of the same light at the same place, are loaded. Returns invalid_argument (field
/// "texels") if the range is not within the baked texels, else the errors of `bake_accumulators`
/// and of the storage.
[[nodiscard]] Result<TexelBake> bake_texel_range(const Scene& scene,
                                                 const PreparedLightmaps& prepared,
                                                 PlaceRange range, const BakeStorage& storage = {},
                                                 const BakeCallback& callback = {},
                                                 const LightmapPreview& preview = {});

/// The same for all baked texels.
[[nodiscard]] Result<TexelBake> bake_texels(const Scene& scene, const PreparedLightmaps& prepared,
                                            const BakeStorage& storage = {},
                                            const BakeCallback& callback = {});

/// Replaces a time budget in the settings, the metadata and the key by the samples that texels had
/// when the bake ended, so that they are those of a bake without a time budget that gives the same
/// light. To be called before lightmaps or parts are written; without a time budget it does
/// nothing.
void record_samples(PreparedLightmaps& prepared, const TexelBake& bake);

struct BakedLightmaps {
    Lightmaps lightmaps;
    LightmapReport report;
};

/// Adds rays, errors and the time of the cache of baked texels to a report. `target_error`: 0 =
/// none.
void report_texels(const TexelBake& bake, double target_error, LightmapReport& report);

/// Gives the pages of prepared lightmaps their texels, without light.
void resize_texels(const LightGroupLayout& layout, Lightmaps& maps);

/// Filters the light, writes it into pages, fills texels that have none, and stitches seams. A
/// function of the light, the prepared lightmaps, maps (but for their points), validity, seams and
/// settings alone. Precondition: the light is that of all baked texels.
[[nodiscard]] BakedLightmaps finish_lightmaps(PreparedLightmaps prepared, const TexelBake& bake);

/// All three steps.
[[nodiscard]] Result<BakedLightmaps> bake_lightmaps(const Scene& scene,
                                                    const BakeLightmapsSettings& settings,
                                                    const BakeStorage& storage = {},
                                                    const BakeCallback& callback = {});

}  // namespace tetralight
