// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/shared_settings.h>

namespace tetralight::settings {
namespace {

constexpr Setting kFiles[] = {
    scene_file("glTF 2.0 scene (.glb or .gltf)"),
    {.name = "output",
     .type = Type::Path,
     .help = "Lightmaps to write, or a part of them (- = stdout)",
     .extensions = ".lightmaps .part",
     .without = "none; required except with --explain",
     .short_name = 'o',
     .access = Access::Command},
    {.name = "only",
     .type = Type::Text,
     .help = "Bake the texels of the object of this name; all others stay black",
     .without = "all objects",
     .value_name = "NODE",
     .is_list = true}};

constexpr Setting kTexels[] = {
    {.name = "places",
     .type = Type::Integer,
     .help = "Light is sampled at up to N x N places of each texel",
     .unit = "places",
     .range = {1, 4},
     .default_text = "2"},
    {.name = "min_validity",
     .type = Type::Number,
     .help = "Smallest fraction of rays that hit no back face; a texel below it is inside geometry "
             "and takes the light of texels beside it",
     .unit = "fraction",
     .range = {0, 1},
     .default_text = "0.75"}};

constexpr Setting kSampling[] = {
    {.name = "samples",
     .type = Type::Integer,
     .help = "Samples per texel: exactly this many, or with --target-error or --time-budget at "
             "least 128",
     .unit = "samples",
     .range = {1, 1 << 24},
     .without = "128 in the first round",
     .short_name = 's'},
    {.name = "target_error",
     .type = Type::Fraction,
     .help = "Double the samples of a texel until its relative standard error is below this",
     .unit = "fraction",
     .range = {0, 1, true},
     .without = "5% with at most 16384 samples, unless --samples or --time-budget is given"},
    {.name = "target_layers",
     .type = Type::Fraction,
     .help = "Double the samples of a texel until the error of each of its layers is below this, "
             "too; a layer counts down to a hundredth of its mean light",
     .unit = "fraction",
     .range = {0, 1, true},
     .without = "no target",
     .needs = "layers"},
    {.name = "max_samples",
     .type = Type::Integer,
     .help = "Most samples per texel with --target-error, --target-layers or --time-budget; with "
             "--samples alone, all texels get as many, in rounds",
     .unit = "samples",
     .range = {1, 0x1p32},
     .without = "64 times --samples"},
    kTimeBudget,
    {.name = "normal_maps",
     .type = Type::Flag,
     .help = "Bake normal maps into the irradiance, for engines that read no directions: texels "
             "have to be as fine as the relief"},
    {.name = "no_filter",
     .type = Type::Flag,
     .help = "Keep the noise of each texel. Without it, texels become means of texels around them "
             "that differ by no more than their noise"},
    seed_setting("Seed of the random numbers")};

constexpr Setting kTransport[] = {
    {.name = "exact",
     .type = Type::Flag,
     .help =
         "Trace each path of light to its end. Without it, a path ends where it meets a texel "
         "whose light was baked before: faster above about a hundred samples, and as fine as the "
         "texels. --bounces and --clamp always trace to the end"},
    kBounces,
    kClamp,
    kAlbedoBoost,
    kMaxAlbedo,
    kMixedLighting,
    {.name = "layers",
     .type = Type::Words,
     .help = "Keep this light in separate layers, which `tetralight relight` can scale later: sun, "
             "sky, emission, light:NAME, material:NAME",
     .without = "one layer",
     .value_name = "LIST"},
    {.name = "ambient_occlusion",
     .type = Type::Number,
     .help = "Also bake how open the surroundings of each texel are up to this distance, as a map "
             "of its own that is in none of the light",
     .unit = "metres",
     .range = {0, 1e6, true},
     .without = "no ambient occlusion"}};

constexpr Setting kStoring[] = {
    {.name = "texels",
     .type = Type::Range,
     .help = "Bake only this range of the texels that are baked, into a .part file for `tetralight "
             "merge`",
     .unit = "texels",
     .without = "all texels",
     .access = Access::Command},
    {.name = "cache",
     .type = Type::Path,
     .help = "Folder of the light that paths end at: take it from there, or make it and keep it "
             "there",
     .without = "made by each bake",
     .value_name = "FOLDER",
     .excludes = "exact",
     .access = Access::Command},
    kResume,
    kChunks,
    kStore,
    kStoreLimit,
    kProgressFile,
    {.name = "preview",
     .type = Type::Path,
     .help = "While it bakes, write the light so far to this file about every 5 seconds: .png = "
             "pages for looking at, .exr = irradiance, one file a page; .lightmaps = all pages, "
             "for `tetralight render` and `export`",
     .without = "no preview",
     .is_list = true,
     .access = Access::Command},
    {.name = "unwrapped",
     .type = Type::Path,
     .help = "Before it bakes, write the scene with its UVs to this .glb file, as `tetralight "
             "unwrap` does",
     .without = "no file",
     .access = Access::Command},
    {.name = "explain",
     .type = Type::Flag,
     .help = "Bake nothing; check the settings, and print what was read of the scene and what a "
             "bake takes from each of its lights",
     .access = Access::Command}};

constexpr Group kGroups[] = {{"Files", kFiles},
                             {"Reading the scene", kSceneReading.rows},
                             {"Added light", kAddedLightAlone},
                             {"Pages", kLightmapPages},
                             {"Texels", kTexels},
                             {"Samples", kSampling},
                             {"Light transport", kTransport},
                             {"Progress and earlier bakes", kStoring},
                             {"Common options", kCommonSettings}};

}  // namespace

const Table kLightmap{.command = "lightmap",
                      .summary = "Bake the light of a scene into lightmaps for what stands still",
                      .examples =
                          "tetralight lightmap courtyard.glb -o courtyard.lightmaps\n"
                          "tetralight lightmap courtyard.glb --texels-per-meter 20 --target-error "
                          "3% -o courtyard.lightmaps",
                      .groups = kGroups};

}  // namespace tetralight::settings
