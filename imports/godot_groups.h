// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/base/result.h>
#include <tetralight/imports/imported_groups.h>

namespace tetralight {

/// Reads the LightmapProbe nodes of a text scene of Godot 4 (.tscn). The probes below one node are
/// a group, with the path of that node from the root as its name: "Level/Hall". Godot's axes and
/// metres are ours.
///
/// A node stands where the transforms of its parents put it, as in Godot: a parent that is not
/// spatial (Node, Control...) or `top_level` ends the chain. Scenes that the file instances are not
/// followed, which is a warning. Probes below a node of such a scene that the file does not place
/// are left out with a warning.
///
/// Returns corrupt, with the line and the node, for text that is not a scene, parents that are not
/// in the file, two nodes of one path, and transforms that are not twelve finite numbers;
/// unsupported for formats other than 3 and 4; not_found without probes.
[[nodiscard]] Result<ImportedGroups> read_godot_groups(const std::string& path);

}  // namespace tetralight
