// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include <tetralight/bake/scene/reflection_place.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// Writes places of reflection probes as a binary glTF scene (.glb): a node with
/// `extras.reflection_probe` for each, which `read_gltf` reads. Returns the errors of
/// `check_reflection_places`.
[[nodiscard]] Status write_reflection_places_glb(const std::string& path,
                                                 std::span<const ReflectionPlace> places);

}  // namespace tetralight
