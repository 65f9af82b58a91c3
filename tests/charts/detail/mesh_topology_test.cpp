// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/detail/mesh_topology.h>

#include <gtest/gtest.h>

#include <set>

#include "tests/charts/chart_meshes.h"

namespace tetralight::detail {
namespace {

std::set<uint32_t> neighbors_of(const MeshTopology& mesh, uint32_t triangle) {
    std::set<uint32_t> neighbors;
    mesh.for_each_neighbor(triangle, [&](uint32_t other) { neighbors.insert(other); });
    return neighbors;
}

TEST(MeshTopology, WeldsEqualPositions) {
    const MeshTopology mesh = make_mesh_topology(box_mesh({-1, -1, -1}, {1, 1, 1}).view());
    EXPECT_EQ(mesh.points.size(), 8u);
    for (uint32_t t = 0; t < 12; ++t) EXPECT_EQ(neighbors_of(mesh, t).size(), 3u) << t;
}

TEST(MeshTopology, NegativeZeroEqualsZero) {
    OwnedMesh mesh;
    mesh.add_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    mesh.add_triangle({1, 0, -0.0f}, {-0.0f, 0, 0}, {0, -1, 0});
    EXPECT_EQ(neighbors_of(make_mesh_topology(mesh.view()), 0), std::set<uint32_t>{1});
}

TEST(MeshTopology, MeasuresTriangles) {
    OwnedMesh mesh;
    mesh.add_triangle({5, 5, 5}, {8, 5, 5}, {5, 9, 5});
    const MeshTopology topology = make_mesh_topology(mesh.view());
    EXPECT_EQ(topology.areas[0], 6.0);
    EXPECT_EQ(topology.normals[0], glm::dvec3(0, 0, 1));
}

TEST(MeshTopology, TrianglesWithoutAreaHaveNoNormal) {
    OwnedMesh mesh;
    mesh.add_triangle({0, 0, 0}, {1, 1, 1}, {3, 3, 3});
    mesh.add_triangle({0, 0, 0}, {0, 0, 0}, {1, 0, 0});
    mesh.add_triangle({2, 2, 2}, {2, 2, 2}, {2, 2, 2});
    const MeshTopology topology = make_mesh_topology(mesh.view());
    for (uint32_t t = 0; t < 3; ++t) {
        EXPECT_EQ(topology.areas[t], 0.0);
        EXPECT_EQ(topology.normals[t], glm::dvec3(0.0));
    }
}

TEST(MeshTopology, AllTrianglesAtAnEdgeAreNeighbors) {
    OwnedMesh mesh;
    for (int i = 0; i < 5; ++i) {
        mesh.add_triangle({0, 0, 0}, {0, 0, 1}, glm::vec3(1, i, 0));
    }
    EXPECT_EQ(neighbors_of(make_mesh_topology(mesh.view()), 2), (std::set<uint32_t>{0, 1, 3, 4}));
}

TEST(MeshTopology, LimitsTheNeighborsAtOneEdge) {
    OwnedMesh mesh;
    for (int i = 0; i < 100; ++i) {
        mesh.add_triangle({0, 0, 0}, {0, 0, 1}, glm::vec3(1, i, 0));
    }
    EXPECT_EQ(neighbors_of(make_mesh_topology(mesh.view()), 2).size(),
              MeshTopology::kMaxNeighborsOfEdge);
}

TEST(MeshTopology, ATriangleIsNotItsOwnNeighbor) {
    OwnedMesh mesh;
    mesh.add_triangle({0, 0, 0}, {1, 0, 0}, {0, 0, 0});
    EXPECT_TRUE(neighbors_of(make_mesh_topology(mesh.view()), 0).empty());
}

}  // namespace
}  // namespace tetralight::detail
