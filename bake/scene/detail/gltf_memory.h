// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/bake/scene/scene_memory.h>
#include <tetralight/base/process/memory.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// The memory of all but the images. `file`: the bytes of the .gltf or .glb file. Precondition:
/// nothing of the document is decoded yet; it needs no buffers.
[[nodiscard]] SceneMemory geometry_memory(const nlohmann::json& source,
                                          const GltfDocument& document,
                                          std::span<const std::byte> file);

/// Bytes of the images that materials use, decoded, by the headers of the images. Images without a
/// readable header count as 0: reading them tells what is wrong. Precondition: the document has its
/// buffers.
[[nodiscard]] uint64_t image_memory(const GltfDocument& document, NormalMaps normal_maps);

/// Returns out_of_resources if reading takes more than `limit_bytes` at one time.
[[nodiscard]] Status check_reading_memory(const SceneMemory& memory,
                                          uint64_t limit_bytes = free_memory());

}  // namespace tetralight::detail
