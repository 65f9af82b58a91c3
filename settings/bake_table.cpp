// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/shared_settings.h>

namespace tetralight::settings {
namespace {

constexpr Setting kFiles[] = {
    scene_file("glTF 2.0 scene (.glb or .gltf)"),
    {.name = "output",
     .type = Type::Path,
     .help = "Probe volume to write, or a part of it (- = stdout)",
     .extensions = ".probes .part",
     .without = "none; required except with --explain",
     .short_name = 'o',
     .access = Access::Command},
    {.name = "groups",
     .type = Type::Path,
     .help = "Probe groups in addition to the scene's own: a .json, .csv, .tscn (Godot), .unity or "
             ".prefab file, or a glTF scene",
     .without = "the scene's own",
     .short_name = 'g',
     .is_list = true},
    {.name = "only_given_groups",
     .type = Type::Flag,
     .help = "Ignore the scene's own probe groups",
     .needs = "groups"}};

constexpr Setting kSampling[] = {
    {.name = "samples",
     .type = Type::Integer,
     .help = "Samples per probe: exactly this many, or with --target-error or --time-budget at "
             "least 128",
     .unit = "samples",
     .range = {1, 1 << 24},
     .without = "1024 in the first round",
     .short_name = 's'},
    {.name = "target_error",
     .type = Type::Fraction,
     .help = "Double the samples of a probe until its relative standard error is below this",
     .unit = "fraction",
     .range = {0, 1, true},
     .without = "0.5% with at most 131072 samples, unless --samples or --time-budget is given"},
    {.name = "target_layers",
     .type = Type::Fraction,
     .help = "Double the samples of a probe until the error of each of its layers is below this, "
             "too; a layer counts down to a hundredth of its mean light",
     .unit = "fraction",
     .range = {0, 1, true},
     .without = "1% with --layers, unless --samples, --target-error or --time-budget is given",
     .needs = "layers"},
    {.name = "max_samples",
     .type = Type::Integer,
     .help = "Most samples per probe with --target-error, --target-layers or --time-budget; with "
             "--samples alone, all probes get as many, in rounds",
     .unit = "samples",
     .range = {1, 0x1p32},
     .without = "64 times --samples"},
    kTimeBudget,
    seed_setting("Seed of the random numbers")};

constexpr Setting kTransport[] = {
    kBounces,
    kClamp,
    kAlbedoBoost,
    kMaxAlbedo,
    kMixedLighting,
    {.name = "layers",
     .type = Type::Words,
     .help = "Keep this light in separate layers, which `tetralight relight` can scale later: sun, "
             "sky, emission, light:NAME, material:NAME; transfer = response to another sky or a "
             "moved sun",
     .without = "one layer",
     .value_name = "LIST"}};

constexpr Setting kProbes[] = {
    kWeld,
    {.name = "min_validity",
     .type = Type::Number,
     .help = "Smallest fraction of rays that hit no back face; a probe below it is inside geometry",
     .unit = "fraction",
     .range = {0, 1},
     .default_text = "0.75"},
    {.name = "virtual_offset",
     .type = Type::Number,
     .help = "Longest distance by which a probe inside geometry may gather its light from outside "
             "of it, as a fraction of the distance to the nearest other probe of its group; 0 = "
             "never",
     .unit = "fraction of the spacing",
     .range = {0, 10},
     .default_text = "0.45"},
    {.name = "invalid_probes",
     .type = Type::Choice,
     .help = "Probes inside geometry that find no virtual offset: leave-out = omit them from the "
             "volume; dilate = give them the light of their neighbors; keep = keep their dark "
             "light",
     .choices = "leave-out dilate keep",
     .default_text = "leave-out"},
    {.name = "dering",
     .type = Type::Flag,
     .help = "Remove ringing (negative irradiance) from the probes of all groups, not only of "
             "those that ask for it"},
    {.name = "dering_window",
     .type = Type::Choice,
     .help = "mildest = the weakest window for each probe that removes its negative irradiance; "
             "hann, lanczos = one window for all probes",
     .choices = "mildest hann lanczos",
     .default_text = "mildest"}};

constexpr Setting kStoring[] = {
    {.name = "probes",
     .type = Type::Range,
     .help = "Bake only this range of the probes, into a .part file for `tetralight merge`",
     .unit = "probes",
     .without = "all probes",
     .access = Access::Command},
    {.name = "prepared",
     .type = Type::Path,
     .help = "Take the probes and cells from this file, which `tetralight plan` wrote, instead of "
             "making them from the groups; the part then holds light alone",
     .without = "made from the groups",
     .needs = "probes",
     .access = Access::Command},
    kResume,
    kChunks,
    kStore,
    kStoreLimit,
    {.name = "reuse",
     .type = Type::Path,
     .help = "Bake only what changed: probes whose position is unchanged take their light from "
             "this volume; if the scene or the settings differ, bake all probes and say why",
     .without = "all probes are baked"},
    kProgressFile,
    {.name = "preview",
     .type = Type::Path,
     .help = "While it bakes, write the volume with the light so far to this file about every 2 "
             "seconds, and at the end the finished volume",
     .extensions = ".probes",
     .without = "no preview",
     .excludes = "probes",
     .access = Access::Command},
    {.name = "check_leaks",
     .type = Type::Flag,
     .help = "After the bake compare its light with traced light at 1000 random places, as "
             "`tetralight check-leaks` does, and report light that comes through walls",
     .excludes = "probes",
     .access = Access::Command},
    {.name = "explain",
     .type = Type::Flag,
     .help = "Bake nothing; print what was read of the scene, what a bake takes from each of its "
             "lights, and what the runtime adds",
     .access = Access::Command}};

constexpr Group kGroups[] = {{"Files", kFiles},
                             {"Reading the scene", kSceneReading.rows},
                             {"Added light", kAddedLight},
                             {"Samples", kSampling},
                             {"Light transport", kTransport},
                             {"Probes", kProbes},
                             {"Progress and earlier bakes", kStoring},
                             {"Common options", kCommonSettings}};

}  // namespace

const Table kBake{.command = "bake",
                  .summary = "Bake the light of a scene into a probe volume",
                  .examples =
                      "tetralight bake courtyard.glb -o courtyard.probes\n"
                      "tetralight bake courtyard.glb --target-error 1% --layers sun,sky "
                      "-o courtyard.probes",
                  .groups = kGroups};

}  // namespace tetralight::settings
