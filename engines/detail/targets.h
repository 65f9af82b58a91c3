// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/engines/export_target.h>

// The functions of `ExportTarget::make`, one source file each.

namespace tetralight::detail {

using MakeExport = Result<ExportedVolume>(const ProbeVolumeView& volume,
                                          const ExportSettings& settings);

MakeExport export_babylon;
MakeExport export_bevy;
MakeExport export_blender;
MakeExport export_csv;
MakeExport export_filament;
MakeExport export_gltf;
MakeExport export_godot;
MakeExport export_json;
MakeExport export_playcanvas;
MakeExport export_three_grid;
MakeExport export_unity;
MakeExport export_unreal;
MakeExport export_vtu;

}  // namespace tetralight::detail
