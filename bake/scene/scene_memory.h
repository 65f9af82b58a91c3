// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace tetralight {

/// Bytes of memory that reading a scene file takes. They are known from its JSON and the headers
/// of its images before anything is decoded.
struct SceneMemory {
    /// The file, its JSON and a decoder's tables: until the buffers are there.
    uint64_t file_bytes = 0;
    /// The buffers, and what compressed ones become: until the scene is read.
    uint64_t buffer_bytes = 0;
    /// Vertices, indices and objects of the scene.
    uint64_t geometry_bytes = 0;
    /// Decoded images of the scene.
    uint64_t image_bytes = 0;

    /// The most that is in use at one time.
    [[nodiscard]] uint64_t peak_bytes() const;
    /// What the scene keeps.
    [[nodiscard]] uint64_t scene_bytes() const;

    bool operator==(const SceneMemory&) const = default;
};

}  // namespace tetralight
