// SPDX-License-Identifier: Apache-2.0
#include <tetralight/engines/export_target.h>

#include <algorithm>

#include <tetralight/engines/detail/targets.h>

namespace tetralight {
namespace {

/// To add a target: a function in a file of its own, a row here, its name among the choices of
/// settings/export_table.cpp, a test, and a section in docs/engines.md.
constexpr ExportTarget kTargets[] = {
    {.name = "three-grid",
     .extension = ".json",
     .help = "a grid of probes for the WebGL renderer of three.js, with its texture beside it",
     .loses = "In a grid light passes through walls that are thinner than its cells.",
     .has_grid = true,
     .make = detail::export_three_grid},
    {.name = "bevy",
     .extension = ".scn.ron",
     .help = "an irradiance volume for Bevy, with its texture beside it",
     .loses = "Bevy shows six directions of light, and in a grid light passes through walls that "
              "are thinner than its cells.",
     .has_grid = true,
     .make = detail::export_bevy},
    {.name = "unreal",
     .extension = ".md",
     .help = "a sheet for a volume texture of Unreal Engine, and a page with a material function",
     .loses = "In a grid light passes through walls that are thinner than its cells.",
     .has_grid = true,
     .make = detail::export_unreal},
    {.name = "gltf",
     .extension = ".glb",
     .help = "cells and light in the glTF extension TETRALIGHT_probe_volume, and probes as points",
     .loses = "Layers, lights, and the errors of probes.",
     .make = detail::export_gltf},
    {.name = "godot",
     .extension = ".tres",
     .help = "LightmapGIData of Godot 4 with probes, and a script that shows it",
     .loses = "Walls between probes, layers, lights and occlusion.",
     .make = detail::export_godot},
    {.name = "unity",
     .extension = ".json",
     .help = "positions and coefficients for Unity, and a script for its editor",
     .loses = "Cells, walls between probes, layers and lights.",
     .make = detail::export_unity},
    {.name = "playcanvas",
     .extension = ".json",
     .help = "the light of places as PlayCanvas' parameter ambientSH",
     .loses = "Cells: a game chooses the place whose light it sets. Occlusion, layers and lights.",
     .has_places = true,
     .make = detail::export_playcanvas},
    {.name = "filament",
     .extension = ".txt",
     .help = "the light of one place as text that Filament's tool cmgen writes",
     .loses = "Occlusion, layers and lights.",
     .has_places = true,
     .make = detail::export_filament},
    {.name = "babylon",
     .extension = ".glb",
     .help = "the light of one place as EXT_lights_image_based, with signs as Babylon.js expects",
     .loses = "Occlusion, layers and lights; reflections show only the light that probes hold.",
     .has_places = true,
     .make = detail::export_babylon},
    {.name = "vtu",
     .extension = ".vtu",
     .help = "probes and cells for ParaView, PyVista and other programs that use VTK",
     .loses = "Walls do not hide probes; outside the hull nothing is lit.",
     .make = detail::export_vtu},
    {.name = "json",
     .extension = ".json",
     .help = "probes and cells as JSON",
     .loses = "Walls between probes, layers and lights.",
     .make = detail::export_json},
    {.name = "csv",
     .extension = ".csv",
     .help = "one probe a line, for spreadsheets",
     .loses = "Cells, walls between probes, layers and lights.",
     .make = detail::export_csv},
    {.name = "blender",
     .extension = ".py",
     .help = "a script that makes a mesh in Blender, whose vertices have the light as attributes",
     .loses = "Cells, walls between probes, layers and lights.",
     .make = detail::export_blender}};

}  // namespace

std::span<const ExportTarget> export_targets() noexcept {
    return kTargets;
}

const ExportTarget* find_export_target(std::string_view name) noexcept {
    const auto found = std::ranges::find(
        kTargets, name, [](const ExportTarget& target) { return std::string_view(target.name); });
    return found == std::end(kTargets) ? nullptr : &*found;
}

}  // namespace tetralight
