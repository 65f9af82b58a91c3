// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// The animation of this name, else the one whose index the text is; empty: the first one. Returns
/// invalid_argument (field "animation") if there is no such animation.
[[nodiscard]] Result<uint32_t> find_animation(const GltfDocument& document,
                                              const std::string& text);

/// As `read_gltf_document`, with the scene and the pose that `reading` chooses.
[[nodiscard]] Result<GltfDocument> read_posed_document(const std::string& path,
                                                       const SceneReading& reading);

/// Puts nodes where an animation has them at a time, in seconds: sets their translation, rotation,
/// scale and weights, and `parent_from_node`. Before the first key the first value applies, after
/// the last key the last one. Channels that do not animate these properties of a node are left out.
/// Returns corrupt if times do not increase, counts do not fit, or an animated node has a matrix.
[[nodiscard]] Status pose_nodes(GltfDocument& document, uint32_t animation, double time);

}  // namespace tetralight::detail
