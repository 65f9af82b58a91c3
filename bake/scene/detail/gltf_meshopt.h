// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// Decodes the buffer views that EXT_meshopt_compression compresses, each into a new buffer to
/// which the view refers from then on. Returns corrupt if a view breaks the extension's rules or
/// its bytes do not decode, and unsupported if they are of a later version of the encoding.
[[nodiscard]] Status decode_meshopt(GltfDocument& document);

/// Bytes of the buffers that decode_meshopt() will add. 2^64 − 1 if the sum is greater.
[[nodiscard]] uint64_t meshopt_decoded_bytes(const GltfDocument& document);

}  // namespace tetralight::detail
