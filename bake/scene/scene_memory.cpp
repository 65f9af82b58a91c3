// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/scene_memory.h>

#include <algorithm>

#include <tetralight/base/process/memory.h>

namespace tetralight {

uint64_t SceneMemory::peak_bytes() const {
    return add_bytes(buffer_bytes, std::max(file_bytes, scene_bytes()));
}

uint64_t SceneMemory::scene_bytes() const {
    return add_bytes(geometry_bytes, image_bytes);
}

}  // namespace tetralight
