// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/base/result.h>
#include <tetralight/imports/imported_groups.h>

// Probe groups from files of other programs. `--groups` reads all its files here:
//
//     const auto imported = import_groups("level.tscn");
//     const auto merged = merge(imported->groups);
//
// To add a format, write a reader in a file of its own and name its extension in the table of
// import_groups.cpp.

namespace tetralight {

/// Reads the probe groups of a file. Its extension, in any case, selects the reader:
///
/// - .csv: columns of numbers (csv_groups.h)
/// - .glb, .gltf: the groups of a scene (read_gltf.h); only this reader uses `reading`
/// - .prefab, .unity: text files of Unity (unity_groups.h)
/// - .tscn: text scenes of Godot (godot_groups.h)
/// - all others: JSON (probe_groups_json.h)
///
/// Positions are metres, right-handed, Y up. Errors begin with the path, and name the line or the
/// object, and the value. Returns not_found if a file that is not JSON has no probe groups.
[[nodiscard]] Result<ImportedGroups> import_groups(const std::string& path,
                                                   const SceneReading& reading = {});

/// The extensions that `import_groups` knows, sorted: ".csv", ".glb"...
[[nodiscard]] std::vector<std::string> group_file_extensions();

}  // namespace tetralight
