// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/base/result.h>
#include <tetralight/imports/imported_groups.h>

namespace tetralight {

/// Reads the LightProbeGroup components of a scene or prefab that Unity wrote as text (.unity,
/// .prefab; YAML). Each is a group, with the names of its object's parents and its object as its
/// name: "Level/Hall". A second group of the same name gets its file ID: "Level/Hall #1234".
///
/// Positions follow the transforms of the object and its parents. Unity's axes are left-handed: x
/// is negated, as Unity's glTF exporters do (docs/conventions.md), so that the groups fit a scene
/// that was exported as glTF. *Remove Ringing* is read as `dering`.
///
/// Groups of objects that are not active, of components that are off, and below prefab instances,
/// whose placement is not in the file, are left out with a warning. Prefab instances are not
/// followed, which is a warning.
///
/// Returns corrupt, with the line, the object and the value, for text that is not YAML of Unity,
/// references to objects that are not in the file, parents in a circle, and numbers that are not
/// finite; not_found if there are no groups of probes.
[[nodiscard]] Result<ImportedGroups> read_unity_groups(const std::string& path);

}  // namespace tetralight
