// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// Decodes the primitives that KHR_draco_mesh_compression compresses. Their accessors refer to new
/// buffer views with the decoded elements from then on, and have the types that the file gives
/// them. If primitives with different compressed data share an accessor, the later ones get
/// accessors of their own. Attributes that are not in the compressed data stay as they are.
/// Returns corrupt if the data do not decode or do not fit the accessors, and unsupported for
/// primitives that are not triangle lists. Precondition: decode_meshopt() has run.
[[nodiscard]] Status decode_draco(GltfDocument& document);

/// Bytes of the buffers that decode_draco() will add, by the counts of the accessors. 2^64 − 1 if
/// the sum is greater.
[[nodiscard]] uint64_t draco_decoded_bytes(const GltfDocument& document);

}  // namespace tetralight::detail
