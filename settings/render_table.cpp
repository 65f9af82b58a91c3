// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/shared_settings.h>

namespace tetralight::settings {
namespace {

constexpr Setting kFiles[] = {input_file("scene", "glTF 2.0 scene (.glb or .gltf)"),
                              input_file("volume", "Probe volume baked from it (.probes)"),
                              output_file(".png", "Picture to write (- = stdout)"), kLightmaps};

constexpr Setting kShown[] = {
    {.name = "show",
     .type = Type::Text,
     .help =
         "Draw over the scene, with commas between: probes (balls with the light of each "
         "probe), cells (their edges; hull edges in orange), lppv (points of proxy volumes), "
         "openings (windows and doors where bakes look for light, and where the sun falls "
         "through them), seams (of lightmaps; red where their sides differ), selection=x,y,z "
         "(the cell at a position, its probes with their weights, and the interpolated light). "
         "Or instead of light and materials: received (light on white surfaces), direct (of "
         "lights that are not baked), bounce (baked light), emission, albedo, normal "
         "(with normal maps), and of lightmaps unwrapped-uv, lightmap-uv, texels, validity, pages, "
         "shadow-mask (of three lights), ambient-occlusion",
     .without = "the scene only",
     .value_name = "LIST"},
    {.name = "ball_radius",
     .type = Type::Number,
     .help = "Radius of the balls",
     .unit = "metres",
     .range = kLengths,
     .without = "from the spacing of the probes",
     .needs = "show"},
    {.name = "probe_color",
     .type = Type::Choice,
     .help = "Color of the balls of probes: light; validity = fraction of rays without back faces; "
             "error = relative standard error (teal is good, yellow fair, red bad)",
     .choices = "light validity error",
     .default_text = "light",
     .needs = "show"},
    {.name = "probes",
     .type = Type::Choice,
     .help = "What takes light from the probes: scene = all objects, as the scene asks; one = all "
             "objects, moving ones from one position each; still = static objects only; none",
     .choices = "scene one still none",
     .default_text = "scene"},
    {.name = "ambient_occlusion",
     .type = Type::Flag,
     .help =
         "Darken the light of lightmaps by their ambient occlusion. Their light has the shadows "
         "of surfaces around it already",
     .needs = "lightmaps"},
    {.name = "shadow_color",
     .type = Type::Vector,
     .help = "Radiance of white surfaces in shadows of moving objects, at least, if lightmaps are "
             "subtractive",
     .unit = "linear RGB",
     .range = kRadiance,
     .without = "the mean light of the sky",
     .value_name = "R,G,B",
     .needs = "lightmaps"},
    {.name = "lightmap_light",
     .type = Type::Choice,
     .help =
         "Light from lightmaps on surfaces with normal maps: directional = on the normals of the "
         "map; flat = as without the map",
     .choices = "directional flat",
     .default_text = "directional",
     .needs = "lightmaps"},
    {.name = "reflections",
     .type = Type::Path,
     .help = "Reflection probes (.ktx2, from `tetralight reflect`), which shiny surfaces mirror",
     .without = "no reflections"},
    {.name = "no_box_projection",
     .type = Type::Flag,
     .help =
         "Reflect cubes as if their light came from far away, not from the sides of their boxes",
     .needs = "reflections"},
    kWalls,
    kRenderer};

constexpr Group kGroups[] = {{"Files", kFiles},
                             {"Reading the scene", kSceneReading.rows},
                             {"Contents", kShown},
                             {"Camera", kView.rows},
                             {"Common options", kCommonSettings}};

}  // namespace

const Table kRender{.command = "render",
                    .summary = "Render a scene with the light of a probe volume",
                    .examples = "tetralight render courtyard.glb courtyard.probes -o courtyard.png",
                    .groups = kGroups};

}  // namespace tetralight::settings
