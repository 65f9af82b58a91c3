// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <tetralight/bake/bake_progress.h>
#include <tetralight/bake/bake_settings.h>
#include <tetralight/bake/reflection/cube_image.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/lightmap/lightmaps.h>
#include <tetralight/pipeline/stored_bake.h>
#include <tetralight/reflection/reflections.h>

// Reflection probes in one function:
//
//     places → virtual offsets → bake_stored_cubes → prefilter_levels → halves → Reflections →
//     .ktx2

namespace tetralight {

struct BakeReflectionsSettings {
    /// Texels along a side of a face of level 0: a power of two, 8 to `kLargestCubeSize`.
    uint32_t cube_size = 128;
    /// `sample_count`: paths, or rays to lightmaps, per texel. Targets and budgets are ignored.
    BakeSettings bake = [] {
        BakeSettings paths;
        paths.sample_count = 256;
        return paths;
    }();
    /// Places inside geometry (`ProbeVisibility::is_inside`) are moved out of it.
    float min_validity = 0.75f;
    /// Add the sky as a probe that is everywhere, if it shines.
    bool has_sky = true;
    /// Light that can change after the bake (`LightingSettings::layers`, without "transfer").
    std::vector<std::string> layers;

    bool operator==(const BakeReflectionsSettings&) const = default;
};

/// What became of one probe.
struct ReflectionFacts {
    std::string name;
    float validity = 1.0f;
    float virtual_offset = 0.0f;  ///< metres from where it was placed
    /// Share of its light that lies above the largest half, and was clamped.
    double clamped_share = 0.0;
};

/// What a bake of reflection probes may take light from.
struct ReflectionSources {
    /// Lightmaps of the scene, at which rays end (`LightmapCubes`); none: rays continue as paths.
    LightmapsView lightmaps{};
    /// Where cubes are taken from and kept.
    BakeStorage storage{};
};

struct BakedReflections {
    Reflections reflections;
    std::vector<ReflectionFacts> facts;  ///< one a probe
    std::vector<std::string> warnings;
    uint64_t ray_count = 0;
    StoredBake stored;
    double bake_seconds = 0.0;
    double prefilter_seconds = 0.0;
};

/// What `bake_reflections` would refuse before it bakes. Returns invalid_argument for a size that
/// is not a power of two or out of range, for a name with a control character or bytes that are not
/// UTF-8, for more cubes than a file holds, for no places while there is no sky, and for layers
/// with lightmaps; unsupported for layer "transfer"; and the errors of `plan_lighting`.
[[nodiscard]] Status check_reflections(const Scene& scene, std::span<const ReflectionPlace> places,
                                       const BakeReflectionsSettings& settings,
                                       const LightmapsView& lightmaps = {});

/// Bakes reflection probes at the places of a scene. Mirrors in their cubes would show the sources
/// of light, so that punctual lights and suns are not in them; what surfaces reflect of these is.
/// A pure function of (scene, places, settings, lightmaps), the same bits for any number of threads
/// and whether cubes are baked or come from stores.
///
/// Returns the errors of `check_reflections`, `bake_stored_cubes` and `LightmapCubes::make`.
/// Lightmaps of another state of the scene are a warning.
[[nodiscard]] Result<BakedReflections> bake_reflections(const Scene& scene,
                                                        std::span<const ReflectionPlace> places,
                                                        const BakeReflectionsSettings& settings,
                                                        const BakeCallback& callback = {},
                                                        const ReflectionSources& sources = {});

/// Appends the levels of one cube, as halves. Values above the largest half become that one.
/// Precondition: a cube of the size of the others.
void add_cube(Reflections& reflections, CubeImage cube, uint32_t thread_count);

/// The same of a cube in layers, whose sum is its light: one cube each, in the order of
/// `reflections.layers`.
void add_layered_cube(Reflections& reflections, std::vector<CubeImage> layers,
                      uint32_t thread_count);

/// The light of an environment alone: the mean of `samples_per_texel` points of each texel.
[[nodiscard]] CubeImage bake_sky_cube(const Environment& environment, uint32_t size,
                                      uint32_t samples_per_texel, uint32_t thread_count = 0);

}  // namespace tetralight
