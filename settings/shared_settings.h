// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/settings/setting.h>

// Settings that several commands have.

namespace tetralight::settings {

/// Every command but `serve`.
inline constexpr Setting kCommonSettings[] = {
    {.name = "json",
     .type = Type::Flag,
     .help = "Print one JSON object on stdout (on stderr when the output goes to stdout), also for "
             "a failure",
     .access = Access::Command},
    {.name = "quiet",
     .type = Type::Flag,
     .help = "Print errors only",
     .short_name = 'q',
     .access = Access::Command},
    {.name = "threads",
     .type = Type::Integer,
     .help = "Threads to use; 0 = one per processor",
     .unit = "threads",
     .range = {0, 65535},
     .default_text = "0",
     .short_name = 'j',
     .access = Access::Command}};

/// `-o`.
constexpr Setting output_file(std::string_view extensions, std::string_view help) {
    return {.name = "output",
            .type = Type::Path,
            .help = help,
            .extensions = extensions,
            .short_name = 'o',
            .is_required = true,
            .access = Access::Command};
}

constexpr Setting input_file(std::string_view name, std::string_view help) {
    return {
        .name = name, .type = Type::Path, .help = help, .is_positional = true, .is_required = true};
}

constexpr Setting scene_file(std::string_view help) {
    return input_file("scene", help);
}

/// How a glTF scene is read.
struct SceneReadingSettings {
    Setting rows[4];
};

/// `scene`: the setting of the scene if it may be left out.
constexpr SceneReadingSettings scene_reading_settings(std::string_view scene) {
    return {{{.name = "scene_name",
              .type = Type::Text,
              .help = "Read the scene of this name, or of this number from 0, of a file that has "
                      "several",
              .without = "the default scene of the file",
              .value_name = "NAME",
              .needs = scene},
             {.name = "time",
              .type = Type::Number,
              .help = "Read the scene as its animation has it at this time",
              .unit = "seconds",
              .range = {0, 1e9},
              .without = "as the scene stands without an animation",
              .value_name = "SECONDS",
              .needs = scene},
             {.name = "animation",
              .type = Type::Text,
              .help = "Name of the animation, or its number in the file from 0",
              .without = "the first animation",
              .value_name = "NAME",
              .needs = "time"},
             {.name = "light_unit",
              .type = Type::Choice,
              .help = "Unit of the intensities of lights: lux = as glTF defines it; watt = the "
                      "file has 683 times as much, as exporters write it that count a watt as 683 "
                      "lumens (Blender: Lighting Mode: Standard), and intensities are divided by "
                      "683",
              .choices = "lux watt",
              .default_text = "lux",
              .needs = scene}}};
}

inline constexpr SceneReadingSettings kSceneReading = scene_reading_settings("");
/// Of commands whose scene may be left out.
inline constexpr SceneReadingSettings kOptionalSceneReading = scene_reading_settings("scene");
/// Of commands that read no light.
inline constexpr std::span<const Setting> kScenePose = std::span(kSceneReading.rows).first(3);

inline constexpr Setting kClearance{.name = "clearance",
                                    .type = Type::Number,
                                    .help = "Least distance of places from surfaces",
                                    .unit = "metres",
                                    .range = {0, 1e9},
                                    .default_text = "0.05"};

constexpr Setting seed_setting(std::string_view help) {
    return {.name = "seed",
            .type = Type::Integer,
            .help = help,
            .unit = "seed",
            .range = kAnyInteger,
            .default_text = "0"};
}

inline constexpr Setting kBounces{
    .name = "bounces",
    .type = Type::Integer,
    .help = "Most reflections of a path; 0 = direct light only, 1000 = all light",
    .unit = "reflections",
    .range = {0, 1000},
    .default_text = "1000",
    .short_name = 'b'};

// Of bakes.

inline constexpr Setting kTimeBudget{
    .name = "time_budget",
    .type = Type::Seconds,
    .help =
        "Begin no further round of samples that would end after this time. The time decides "
        "the number of rounds alone",
    .unit = "seconds",
    .range = {0, 1e9, true},
    .without = "no limit",
    .access = Access::Command};

inline constexpr Setting kClamp{
    .name = "clamp",
    .type = Type::Number,
    .help = "Largest radiance of one path, for less noise and less light; 0 = not clamped",
    .unit = "radiance",
    .range = kRadiance,
    .default_text = "0"};

inline constexpr Setting kAlbedoBoost{
    .name = "albedo_boost",
    .type = Type::Number,
    .help = "Raise albedo to the power of 1 / B, so that more light bounces; 1 = unchanged",
    .unit = "exponent",
    .range = {1, 10},
    .default_text = "1",
    .value_name = "B"};

inline constexpr Setting kMaxAlbedo{.name = "max_albedo",
                                    .type = Type::Number,
                                    .help = "Largest albedo of any surface",
                                    .unit = "fraction",
                                    .range = {0, 1},
                                    .default_text = "1"};

inline constexpr Setting kMixedLighting{
    .name = "mixed_lighting",
    .type = Type::Choice,
    .help =
        "Shadows of mixed lights: indirect = all in real time; shadowmask, subtractive = "
        "probes, and texels of a shadowmask, also hold the occlusion of up to four lights; the "
        "texels of subtractive lightmaps hold the direct light of mixed lights",
    .choices = "indirect shadowmask subtractive",
    .default_text = "indirect"};

inline constexpr Setting kResume{
    .name = "resume",
    .type = Type::Flag,
    .help = "Continue an interrupted bake from the store beside the output",
    .access = Access::Command};

inline constexpr Setting kChunks{
    .name = "chunks",
    .type = Type::Path,
    .help =
        "Keep what is finished in this folder, saved after every few, and continue from those "
        "that are already there; the bake fails if they cannot be saved",
    .without = "no chunks",
    .value_name = "FOLDER",
    .excludes = "store",
    .access = Access::Command};

inline constexpr Setting kStore{
    .name = "store",
    .type = Type::Path,
    .help = "Folder of baked light that many bakes share: take what is known, and add the rest",
    .without = "no store",
    .value_name = "FOLDER",
    .excludes = "chunks",
    .access = Access::Command};

inline constexpr Setting kStoreLimit{
    .name = "store_limit",
    .type = Type::Number,
    .help = "After the bake, delete the least recently used light of the store above this size",
    .unit = "gigabytes",
    .range = {0, 1e9, true},
    .without = "no limit",
    .needs = "store",
    .access = Access::Command};

inline constexpr Setting kProgressFile{
    .name = "progress_file",
    .type = Type::Path,
    .help = "Write the progress to this file as JSON, twice a second",
    .without = "no file",
    .access = Access::Command};

inline constexpr Setting kWeld{
    .name = "weld",
    .type = Type::Number,
    .help =
        "Join probes that are nearer to each other than this fraction of the local spacing: "
        "the distance to the seventh nearest probe, at most 10 m",
    .unit = "fraction of the spacing",
    .range = {0, 0.1},
    .default_text = "0.0001"};

inline constexpr Setting kRenderingLayers{
    .name = "rendering_layers",
    .type = Type::Integers,
    .help =
        "Rendering layers that the lit object is on: probes on none of them do not light it "
        "where their cell has others",
    .unit = "layers",
    .range = {0, 31},
    .without = "all layers",
    .value_name = "N,N,..."};

inline constexpr Setting kRadius{
    .name = "radius",
    .type = Type::Number,
    .help =
        "Distance over which the light of probes behind a wall fades, such as the radius of "
        "the lit object; 0 = 3 % of the distance from the probe to the wall",
    .unit = "metres",
    .range = {0, 1e9},
    .default_text = "0"};

constexpr Setting sky_setting(std::string_view help) {
    return {.name = "sky",
            .type = Type::Sky,
            .help = help,
            .unit = "radiance",
            .range = kRadiance,
            .without = "the sky stays"};
}

inline constexpr Setting kSkyIntensity{.name = "sky_intensity",
                                       .type = Type::Number,
                                       .help = "Factor on the radiance of the sky",
                                       .unit = "factor",
                                       .range = kRadiance,
                                       .default_text = "1"};

inline constexpr Setting kSkyRotation{
    .name = "sky_rotation",
    .type = Type::Number,
    .help = "Rotate the sky about +Y, counter-clockwise seen from above",
    .unit = "degrees",
    .range = {-360, 360},
    .default_text = "0"};

/// Adjustment volumes, and light that a command adds to a scene.
inline constexpr Setting kAddedLight[] = {
    {.name = "adjustments",
     .type = Type::Path,
     .help = "File of adjustment volumes (.json) in addition to the scene's own: where probes are "
             "forbidden, denser, valid, or scaled",
     .without = "the scene's own only",
     .access = Access::Command},
    sky_setting("Radiance of the sky: R,G,B or one number for a constant sky, or an "
                "equirectangular .hdr or .exr file; replaces the scene's own"),
    kSkyIntensity,
    kSkyRotation,
    {.name = "sun_direction",
     .type = Type::Direction,
     .help = "Add a sun that shines in this direction",
     .unit = "direction",
     .range = kPositions,
     .without = "no sun is added",
     .needs = "sun_irradiance"},
    {.name = "sun_irradiance",
     .type = Type::Vector,
     .help = "Irradiance of the added sun on a surface that faces it",
     .unit = "irradiance",
     .range = kRadiance,
     .without = "no sun is added",
     .value_name = "R,G,B",
     .needs = "sun_direction"},
    {.name = "sun_angle",
     .type = Type::Number,
     .help = "Angular diameter of the added sun, for soft shadows (the real sun's is 0.53)",
     .unit = "degrees",
     .range = {0, 180},
     .default_text = "0",
     .needs = "sun_direction"},
    {.name = "sun_mode",
     .type = Type::Choice,
     .help = "What is baked of the added sun: its bounces (mixed), or its direct light too "
             "(baked)",
     .choices = "mixed baked",
     .default_text = "mixed",
     .needs = "sun_direction"}};

/// The same without adjustment volumes, which change probes alone.
inline constexpr std::span<const Setting> kAddedLightAlone = std::span(kAddedLight).subspan(1);

/// Where lightmaps have their texels.
inline constexpr Setting kLightmapPages[] = {
    {.name = "texels_per_meter",
     .type = Type::Number,
     .help = "Density of texels in the world; extras.lightmap_scale of an object is a factor on it",
     .unit = "texels per metre",
     .range = {0.0001, 100000},
     .default_text = "10",
     .short_name = 't'},
    {.name = "page_size",
     .type = Type::Integer,
     .help = "Width and height of a page",
     .unit = "texels",
     .range = {16, 16384},
     .default_text = "1024"},
    {.name = "uvs",
     .type = Type::Choice,
     .help = "TEXCOORD_1 of meshes that have it: unwrap = make new charts; keep = use it as it is; "
             "repair = use it, but make new charts where it overlaps itself or leaves 0 to 1",
     .choices = "unwrap keep repair",
     .default_text = "unwrap"},
    {.name = "max_angle",
     .type = Type::Number,
     .help = "Largest angle between a triangle and the plane of its chart: larger gives fewer "
             "charts and more stretch",
     .unit = "degrees",
     .range = {1, 85},
     .default_text = "42"}};

/// The camera and the size of a picture. `needed`: a setting that all of them need.
struct ViewSettings {
    Setting rows[8];
};

constexpr ViewSettings view_settings(std::string_view needed, std::string_view eye_needs,
                                     std::string_view fov_needs) {
    return {{{.name = "width",
              .type = Type::Integer,
              .help = "Width of the picture",
              .unit = "pixels",
              .range = {1, 16384},
              .default_text = "960",
              .needs = needed},
             {.name = "height",
              .type = Type::Integer,
              .help = "Height of the picture",
              .unit = "pixels",
              .range = {1, 16384},
              .default_text = "540",
              .needs = needed},
             {.name = "antialias",
              .type = Type::Integer,
              .help = "Camera rays per pixel along each axis",
              .unit = "rays",
              .range = {1, 16},
              .default_text = "4",
              .needs = needed},
             {.name = "exposure",
              .type = Type::Number,
              .help = "Factor before tone mapping (Khronos PBR Neutral); 0 = automatic",
              .unit = "factor",
              .range = {0, 1e9},
              .default_text = "0",
              .needs = needed},
             {.name = "eye",
              .type = Type::Vector,
              .help = "Camera position",
              .unit = "metres",
              .range = kPositions,
              .without = "a camera that sees the scene",
              .needs = eye_needs},
             {.name = "target",
              .type = Type::Vector,
              .help = "Point that the camera looks at",
              .unit = "metres",
              .range = kPositions,
              .without = "a camera that sees the scene",
              .needs = needed.empty() ? "eye" : "eye preview"},
             {.name = "fov",
              .type = Type::Number,
              .help = "Vertical field of view of the camera at --eye",
              .unit = "degrees",
              .range = {1, 170},
              .default_text = "45",
              .needs = fov_needs},
             {.name = "camera",
              .type = Type::Text,
              .help = "Name of a camera of the scene",
              .without = "the scene's first camera, or an overview",
              .value_name = "NAME",
              .needs = needed,
              .excludes = "eye"}}};
}

inline constexpr ViewSettings kView = view_settings("", "target", "eye");
/// Without the cameras of a scene.
inline constexpr std::span<const Setting> kPlainView = std::span(kView.rows).first(7);

inline constexpr Setting kWalls{
    .name = "walls",
    .type = Type::Choice,
    .help =
        "Probes behind walls that the volume knows: hide = they do not count; ignore = plain "
        "weights, whose light shines through walls",
    .choices = "hide ignore",
    .default_text = "hide"};

inline constexpr Setting kLightmaps{
    .name = "lightmaps",
    .type = Type::Path,
    .help =
        "Lightmaps baked from the scene (.lightmaps): static objects take their light from "
        "them, all others from the probes",
    .without = "all objects take light from the probes"};

inline constexpr Setting kRenderer{
    .name = "renderer",
    .type = Type::Choice,
    .help =
        "cpu = by rays, the same bytes on every machine; gl = by OpenGL 4.5, faster on a GPU "
        "(warns if the driver is software, and uses cpu without OpenGL)",
    .choices = "cpu gl",
    .default_text = "cpu",
    .access = Access::Command};

}  // namespace tetralight::settings
