// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/shared_settings.h>

namespace tetralight::settings {
namespace {

constexpr Setting kFiles[] = {
    input_file("volume", "Probe volume (.probes)"),
    {.name = "output",
     .type = Type::Path,
     .help = "Picture to write (- = stdout)",
     .extensions = ".png",
     .without = "none; required except with --window",
     .short_name = 'o',
     .access = Access::Command},
    {.name = "scene",
     .type = Type::Path,
     .help = "glTF 2.0 scene to show around the ball",
     .without = "the sky only"},
    kLightmaps,
    {.name = "reflections",
     .type = Type::Path,
     .help = "Reflection probes (.ktx2, from `tetralight reflect`), which "
             "the spheres and shiny surfaces of the scene mirror",
     .without = "no reflections"}};

constexpr Setting kBall[] = {
    {.name = "count",
     .type = Type::Integer,
     .help = "Spheres in the ball",
     .unit = "spheres",
     .range = {0, 10'000'000},
     .default_text = "1023"},
    {.name = "center",
     .type = Type::Vector,
     .help = "Center of the ball",
     .unit = "metres",
     .range = kPositions,
     .without = "the center of the probes, or a probe near it with room around it"},
    {.name = "radius",
     .type = Type::Number,
     .help = "Radius of the ball",
     .unit = "metres",
     .range = kLengths,
     .without = "from the probes"},
    seed_setting("Seed of the positions and colors"),
    {.name = "plain", .type = Type::Flag, .help = "White, rough spheres, which show light alone"},
    {.name = "roughness",
     .type = Type::Number,
     .help = "The spheres are metal of this roughness; 0 = mirrors",
     .unit = "factor",
     .range = {0, 1},
     .without = "a quarter of them is metal, of any roughness",
     .needs = "reflections"},
    {.name = "lppv",
     .type = Type::Flag,
     .help = "Light the spheres by one grid around the ball instead of one query each, so that "
             "moving them needs no further query"},
    {.name = "off",
     .type = Type::Flag,
     .help = "Render the spheres without probe light",
     .excludes = "lppv"},
    kWalls,
    {.name = "specular",
     .type = Type::Flag,
     .help = "Add mirror reflections of the lights, and of the brightest direction of the probes' "
             "light"},
    {.name = "frames",
     .type = Type::Integer,
     .help = "Pictures in which the ball turns once: NAME_0000.png and so on; with --window the "
             "frames until it closes",
     .unit = "pictures",
     .range = {1, 10'000},
     .default_text = "1"},
    {.name = "window",
     .type = Type::Flag,
     .help = "Show it in a window (OpenGL): drag to turn, wheel to zoom; P probes, L proxy volume, "
             "O off, S specular, space to stop",
     .excludes = "output",
     .access = Access::Command},
    kRenderer};

constexpr Group kGroups[] = {{"Files", kFiles},
                             {"Reading the scene", kOptionalSceneReading.rows},
                             {"Ball", kBall},
                             {"Camera", kPlainView},
                             {"Common options", kCommonSettings}};

}  // namespace

const Table kMeshball{
    .command = "meshball",
    .summary = "Render 1023 spheres lit by one batch query of a probe volume",
    .examples = "tetralight meshball courtyard.probes --scene courtyard.glb -o ball.png",
    .groups = kGroups};

}  // namespace tetralight::settings
