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
    {.name = "vtu",
     .extension = ".vtu",
     .help = "probes and cells for ParaView, PyVista and other programs that use VTK",
     .loses = "Walls hide no probes, and there is no light outside of the hull.",
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
     .make = detail::export_csv}};

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
