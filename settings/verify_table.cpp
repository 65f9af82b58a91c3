// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/shared_settings.h>

namespace tetralight::settings {
namespace {

constexpr Setting kFiles[] = {
    scene_file("glTF 2.0 scene that the volume was baked from (.glb or .gltf)"),
    input_file("volume", "Baked probe volume (.probes)"),
    {.name = "html",
     .type = Type::Path,
     .help = "Page to write with the verdict, charts, and the worst probes and places",
     .extensions = ".html",
     .without = "no page is written",
     .access = Access::Command}};

constexpr Setting kReferee[] = {
    {.name = "referee",
     .type = Type::Choice,
     .help = "What traces the light: path-tracer = a plain path tracer of this program; cycles = "
             "Cycles in Blender, which is installed apart",
     .choices = "path-tracer cycles",
     .default_text = "path-tracer",
     .access = Access::Command},
    {.name = "blender",
     .type = Type::Path,
     .help = "Blender to run",
     .without = "blender of PATH",
     .value_name = "PROGRAM",
     .needs = "referee",
     .access = Access::Command},
    {.name = "probes",
     .type = Type::Integer,
     .help = "Random probes of the volume to compare, spread over it",
     .unit = "probes",
     .range = {0, 10'000'000},
     .default_text = "400",
     .access = Access::Command},
    {.name = "places",
     .type = Type::Integer,
     .help = "Random places of free space to compare the interpolated light at",
     .unit = "places",
     .range = {0, 1'000'000},
     .default_text = "400",
     .access = Access::Command},
    kClearance,
    {.name = "target_error",
     .type = Type::Fraction,
     .help = "Standard error of the traced light of a probe that is aimed at, in each channel; "
             "places get four times as much",
     .unit = "fraction",
     .range = {0, 1, true},
     .default_text = "0.01",
     .excludes = "samples",
     .access = Access::Command},
    {.name = "samples",
     .type = Type::Integer,
     .help = "Paths of each probe and place, whatever their error",
     .unit = "paths",
     .range = {4096, 1 << 30},
     .without = "as many as the target error needs",
     .short_name = 's',
     .access = Access::Command},
    {.name = "max_samples",
     .type = Type::Integer,
     .help = "Most paths of one probe or place",
     .unit = "paths",
     .range = {4096, 1 << 30},
     .default_text = "4194304",
     .access = Access::Command},
    {.name = "time_limit",
     .type = Type::Seconds,
     .help = "Begin no probe and no place after this time; the report counts those that are left",
     .unit = "seconds",
     .range = {0, 1e9, true},
     .without = "no limit",
     .access = Access::Command},
    {.name = "bounces",
     .type = Type::Integer,
     .help = "Most reflections of a path; 1000 = all light",
     .unit = "reflections",
     .range = {0, 1000},
     .without = "as many as the bake had",
     .short_name = 'b',
     .access = Access::Command},
    seed_setting("Seed of the choice of probes and places, and of the paths")};

constexpr Setting kLimits[] = {
    {.name = "max_bar",
     .type = Type::Fraction,
     .help = "A probe is undecided if the standard error of both lights together is more than "
             "this fraction of the light",
     .unit = "fraction",
     .range = {0, 1, true},
     .default_text = "0.02",
     .access = Access::Command},
    {.name = "min_within",
     .type = Type::Number,
     .help = "Fail if fewer of the decided probes are within three standard errors",
     .unit = "fraction",
     .range = {0, 1},
     .default_text = "0.99",
     .access = Access::Command},
    {.name = "max_mean_z",
     .type = Type::Number,
     .help = "Fail if the mean difference at decided probes, in standard errors, is farther from 0 "
             "than this and three times what chance gives",
     .unit = "standard errors",
     .range = {0, 1e9},
     .default_text = "0.1",
     .access = Access::Command},
    {.name = "max_undecided",
     .type = Type::Number,
     .help = "Fail if more of the probes are undecided",
     .unit = "fraction",
     .range = {0, 1},
     .default_text = "0.1",
     .access = Access::Command},
    {.name = "max_leak_share",
     .type = Type::Number,
     .help = "Fail if more of the places have light where the referee finds little: half as much "
             "again as the traced light, and 5 % of the mean light above it",
     .unit = "fraction",
     .range = {0, 1},
     .default_text = "0.05",
     .access = Access::Command},
    {.name = "max_unseen_share",
     .type = Type::Number,
     .help = "Fail if more of the places see no probe of their cell",
     .unit = "fraction",
     .range = {0, 1},
     .default_text = "0.05",
     .access = Access::Command},
    {.name = "max_interpolation",
     .type = Type::Number,
     .help = "Fail if the mean difference of interpolated and traced light is more than this "
             "fraction of the mean light",
     .unit = "fraction",
     .range = {0, 1e9},
     .default_text = "0.25",
     .access = Access::Command}};

constexpr Group kGroups[] = {{"Files", kFiles},
                             {"Reading the scene", kSceneReading.rows},
                             {"Light of the bake", kAddedLight},
                             {"Referee", kReferee},
                             {"Limits", kLimits},
                             {"Common options", kCommonSettings}};

}  // namespace

const Table kVerify{
    .command = "verify",
    .summary = "Compare a volume's light with that of an independent path tracer, in error bars",
    .examples =
        "tetralight verify court.glb court.probes\n"
        "tetralight verify court.glb court.probes --probes 1000 --target-error 0.5%\n"
        "tetralight verify court.glb court.probes --html court.html",
    .groups = kGroups};

}  // namespace tetralight::settings
