// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/sparse_blocks.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include <tetralight/bake/scene/scene_bounds.h>

namespace tetralight {
namespace {

using Triangle = std::array<glm::dvec3, 3>;

/// Splits a triangle until each piece is no larger than a block, and adds the boxes of the pieces:
/// the box of a large slanted triangle would add blocks far from it.
Status add_triangle(const Triangle& whole, double reach, SparseBlocks& blocks) {
    const double largest = kSparseBlockSide * blocks.spacing();
    std::vector<Triangle> pending{whole};
    while (!pending.empty()) {
        const Triangle triangle = pending.back();
        pending.pop_back();
        const glm::dvec3 min = glm::min(glm::min(triangle[0], triangle[1]), triangle[2]);
        const glm::dvec3 max = glm::max(glm::max(triangle[0], triangle[1]), triangle[2]);
        const glm::dvec3 size = max - min;
        if (!(std::max({size.x, size.y, size.z}) > largest)) {
            if (auto status = blocks.add_box(min - reach, max + reach); !status) return status;
            continue;
        }
        std::array<double, 3> lengths{};
        for (size_t i = 0; i < 3; ++i) {
            lengths[i] = glm::distance(triangle[i], triangle[(i + 1) % 3]);
        }
        const auto edge = static_cast<size_t>(std::ranges::max_element(lengths) - lengths.begin());
        const glm::dvec3 center = 0.5 * (triangle[edge] + triangle[(edge + 1) % 3]);
        const glm::dvec3& opposite = triangle[(edge + 2) % 3];
        pending.push_back({triangle[edge], center, opposite});
        pending.push_back({center, triangle[(edge + 1) % 3], opposite});
    }
    return Ok{};
}

}  // namespace

Status add_blocks_near_probes(const ProbeVolumeView& volume, double reach, SparseBlocks& blocks) {
    for (const glm::vec3& local : volume.positions) {
        const glm::dvec3 position = volume.info.world_origin + glm::dvec3(local);
        if (auto status = blocks.add_box(position - reach, position + reach); !status) {
            return status;
        }
    }
    return Ok{};
}

Status add_blocks_near_surfaces(const Scene& scene, double reach, SparseBlocks& blocks) {
    for (const MeshInstance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            Triangle triangle;
            for (size_t k = 0; k < 3; ++k) {
                triangle[k] = world_position(instance, mesh.positions[mesh.indices[i + k]]);
            }
            if (auto status = add_triangle(triangle, reach, blocks); !status) return status;
        }
    }
    return Ok{};
}

}  // namespace tetralight
