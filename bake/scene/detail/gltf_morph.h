// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// The weights of the morph targets of a node with a mesh: those of the node, else those of the
/// mesh. Targets behind them have the weight 0. Empty if all weights of targets are 0.
[[nodiscard]] std::vector<double> morph_weights(const GltfDocument& document, uint32_t node);

/// Moves the vertices of a primitive by its morph targets: position += Σ weight · difference, and
/// likewise normals and tangents, which are normalized then. Returns corrupt if the elements of a
/// target are not as many as the vertices.
[[nodiscard]] Status apply_morph_targets(const GltfDocument& document,
                                         const GltfPrimitive& primitive,
                                         std::span<const double> weights, Mesh& mesh);

}  // namespace tetralight::detail
