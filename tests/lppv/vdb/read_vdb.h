// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <vector>

// Files as OpenVDB's and NanoVDB's own readers see them.

namespace tetralight::test {

struct ReadVoxel {
    glm::ivec3 index{0};
    glm::vec3 value{0.0f};  ///< of float grids: all three
};

struct ReadGrid {
    /// Those of tiles too.
    std::vector<ReadVoxel> active;
    uint64_t tile_count = 0;  ///< of .nvdb not counted
    bool is_vector = false;
    bool is_saved_as_half = false;
    std::map<std::string, std::string> metadata;
    /// World positions of the indices (0, 0, 0) and (1, 2, 3).
    glm::dvec3 origin{0.0};
    glm::dvec3 place_of_123{0.0};
};

using ReadGrids = std::map<std::string, ReadGrid>;

/// By openvdb::io::File; throws what that throws.
[[nodiscard]] ReadGrids read_vdb(const std::string& path, std::map<std::string, std::string>& meta);

/// By nanovdb::io::readGrids.
[[nodiscard]] ReadGrids read_nvdb(const std::string& path);

}  // namespace tetralight::test
