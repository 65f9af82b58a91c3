// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/corner_faces.h>

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

TEST(CornerFaces, AreAllCornersOfInnerCells) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(50, 1));
    const CornerFaces corners(volume.view());
    size_t count = 0;
    for (uint32_t probe = 0; probe < 50; ++probe) {
        for (const CornerFace& face : corners.faces(probe)) {
            ++count;
            std::array<uint32_t, 4> expected = volume.cells[face.cell].vertices;
            std::array<uint32_t, 4> found{face.probe, face.others[0], face.others[1],
                                          face.others[2]};
            std::ranges::sort(expected);
            std::ranges::sort(found);
            EXPECT_EQ(found, expected);
            EXPECT_EQ(face.probe, probe);
            EXPECT_EQ(face.other_count, 3);
        }
    }
    EXPECT_EQ(count, size_t{4} * volume.info.inner_cell_count);
}

TEST(FacePositions, AreInsideTheFaceAndBalanced) {
    for (int vertex_count = 1; vertex_count <= 3; ++vertex_count) {
        const auto positions = face_positions(vertex_count, 4);
        EXPECT_EQ(positions.size(), vertex_count == 1 ? 1u : vertex_count == 2 ? 5u : 15u);
        glm::dvec3 sum(0.0);
        for (const glm::dvec3& weights : positions) {
            EXPECT_NEAR(weights.x + weights.y + weights.z, 1.0, 1e-12);
            for (int i = 0; i < vertex_count; ++i) EXPECT_GT(weights[i], 0.0);
            sum += weights;
        }
        for (int i = 0; i < 3; ++i) {
            const double mean = sum[i] / static_cast<double>(positions.size());
            EXPECT_NEAR(mean, i < vertex_count ? 1.0 / vertex_count : 0.0, 1e-12);
        }
    }
}

}  // namespace
}  // namespace tetralight
