// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/shared_settings.h>

namespace tetralight::settings {
namespace {

constexpr Setting kFiles[] = {scene_file("glTF 2.0 scene (.glb or .gltf)"),
                              output_file(".json .glb", "Probe-group file to write (- = stdout)")};

constexpr Setting kPlacement[] = {
    {.name = "mode",
     .type = Type::Choice,
     .help = "regular = a lattice; layers = at heights above every floor; surface = on both sides "
             "of walls; adaptive = denser where light changes",
     .choices = "regular layers surface adaptive",
     .default_text = "regular"},
    {.name = "spacing",
     .type = Type::Scale,
     .help = "Distance between probes, one number or one per axis; --mode adaptive starts with it",
     .unit = "metres",
     .range = kLengths,
     .without = "none; with --mode adaptive an eighth of the longest side"},
    {.name = "min",
     .type = Type::Vector,
     .help = "Minimum corner of the box to fill",
     .unit = "metres",
     .range = kPositions,
     .without = "the bounds of the scene",
     .needs = "max"},
    {.name = "max",
     .type = Type::Vector,
     .help = "Maximum corner of the box to fill",
     .unit = "metres",
     .range = kPositions,
     .without = "the bounds of the scene",
     .needs = "min"},
    {.name = "bounds_of",
     .type = Type::Text,
     .help = "Fill the bounds of the node of this name",
     .without = "the bounds of the scene",
     .value_name = "NAME",
     .is_list = true,
     .excludes = "min"},
    {.name = "heights",
     .type = Type::Numbers,
     .help = "Heights above the floor with --mode layers",
     .unit = "metres",
     .range = kLengths,
     .default_text = "0.3,1.7"},
    {.name = "clearance",
     .type = Type::Number,
     .help = "Smallest distance of probes from surfaces",
     .unit = "metres",
     .range = {0, 1e9},
     .without = "a tenth of the spacing, at most 0.25; 0.05 with --mode adaptive"},
    {.name = "agent_radius",
     .type = Type::Number,
     .help = "Radius of what moves: spaces join where a ball of this size passes",
     .unit = "metres",
     .range = {0, 1e9},
     .without = "a tenth of the spacing, at most 0.25"},
    {.name = "from",
     .type = Type::Vector,
     .help = "Fill the space that contains this position",
     .unit = "metres",
     .range = kPositions,
     .without = "the largest space that light reaches",
     .is_list = true},
    {.name = "navmesh",
     .type = Type::Path,
     .help = "glTF file whose meshes say where things move; probes stand above them",
     .without = "nodes with extras.walkable",
     .access = Access::Command},
    {.name = "agent_height",
     .type = Type::Number,
     .help = "Height above the walkable surface up to which probes light; needs a walkable surface",
     .unit = "metres",
     .range = kLengths,
     .default_text = "2"},
    {.name = "unreachable",
     .type = Type::Choice,
     .help = "Probes in other spaces",
     .choices = "drop keep",
     .default_text = "drop"},
    {.name = "keep_dark",
     .type = Type::Flag,
     .help = "Keep probes in spaces that no light of any mode reaches"},
    {.name = "max_probes",
     .type = Type::Integer,
     .help = "Refuse grids with more candidates; --mode adaptive stays below it",
     .unit = "probes",
     .range = {1, 0x1p64},
     .without = "10000000; 5000 with --mode adaptive"}};

constexpr Setting bounces() {
    Setting setting = kBounces;
    setting.help = "Most reflections of a path; 1000 = all light";
    return setting;
}

constexpr Setting kAdaptive[] = {
    {.name = "target_error",
     .type = Type::Fraction,
     .help = "Stop when interpolated light is this near to the true light: root mean square, as a "
             "fraction of the irradiance",
     .unit = "fraction",
     .range = {0, 1, true},
     .default_text = "5%"},
    {.name = "error",
     .type = Type::Choice,
     .help = "What errors are relative to: the mean irradiance (absolute), that of each place "
             "(relative), or the geometric mean of both, close to what pictures show (mixed)",
     .choices = "absolute relative mixed",
     .default_text = "mixed"},
    {.name = "time_budget",
     .type = Type::Seconds,
     .help = "Stop after this time and keep the probes placed so far; the result is not "
             "reproducible",
     .unit = "seconds",
     .range = {0, 1e9, true},
     .without = "no limit",
     .access = Access::Command},
    bounces(),
    seed_setting("Seed of the random numbers")};

constexpr Setting kOutput[] = {{.name = "name",
                                .type = Type::Text,
                                .help = "Name of the probe groups",
                                .default_text = "grid",
                                .value_name = "NAME"},
                               {.name = "region_size",
                                .type = Type::Number,
                                .help = "Split the groups by cubes of this size; 0 = not split",
                                .unit = "metres",
                                .range = {0, 1e9},
                                .default_text = "0"}};

constexpr Setting kReflections[] = {
    {.name = "reflections",
     .type = Type::Path,
     .help = "File of reflection probes to write: one in each room, with its box at the walls, and "
             "others outdoors",
     .extensions = ".json .glb",
     .without = "no reflection probes",
     .access = Access::Command},
    {.name = "reflection_spacing",
     .type = Type::Number,
     .help = "Largest distance between reflection probes outdoors",
     .unit = "metres",
     .range = {0.1, 1e9},
     .default_text = "10",
     .needs = "reflections",
     .access = Access::Command}};

constexpr Setting kPreviewFile[] = {
    {.name = "preview",
     .type = Type::Path,
     .help = "Picture to write: the scene with its probes, lit by a quick bake, and with places "
             "that no probe covers, in red; balls behind walls show through (- = stdout)",
     .extensions = ".png",
     .without = "no picture",
     .access = Access::Command}};

constexpr ViewSettings preview_view() {
    ViewSettings view = view_settings("preview", "target preview", "eye preview");
    for (Setting& row : view.rows) row.access = Access::Command;
    return view;
}

constexpr ViewSettings kPreviewView = preview_view();

constexpr Group kGroups[] = {{"Files", kFiles},
                             {"Reading the scene", kSceneReading.rows},
                             {"Placement", kPlacement},
                             {"With --mode adaptive", kAdaptive},
                             {"Groups", kOutput},
                             {"Reflection probes", kReflections},
                             {"Added light", kAddedLight},
                             {"Preview", kPreviewFile},
                             {"Camera of the preview", kPreviewView.rows},
                             {"Common options", kCommonSettings}};

}  // namespace

const Table kGrid{.command = "grid",
                  .summary = "Fill a scene with probes",
                  .examples = "tetralight grid courtyard.glb --spacing 2 -o grid.json",
                  .groups = kGroups};

}  // namespace tetralight::settings
