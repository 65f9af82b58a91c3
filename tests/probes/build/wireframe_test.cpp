// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/wireframe.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

/// Every edge by brute force: pairs of probes that some inner cell holds both.
std::set<ProbeEdge> joined_pairs(const ProbeVolume& volume) {
    std::set<ProbeEdge> edges;
    for (uint32_t cell = 0; cell < volume.info.inner_cell_count; ++cell) {
        for (const uint32_t a : volume.cells[cell].vertices) {
            for (const uint32_t b : volume.cells[cell].vertices) {
                if (a < b && b != kNoIndex) edges.insert({a, b});
            }
        }
    }
    return edges;
}

std::vector<ProbeEdge> all_edges(const Wireframe& wireframe) {
    std::vector<ProbeEdge> edges = wireframe.inner_edges;
    edges.insert(edges.end(), wireframe.hull_edges.begin(), wireframe.hull_edges.end());
    return edges;
}

TEST(Wireframe, HoldsEveryEdgeOfACellOnce) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(200, 1));
    const auto edges = all_edges(make_wireframe(volume.view()));
    const std::set<ProbeEdge> unique(edges.begin(), edges.end());
    EXPECT_EQ(unique.size(), edges.size());
    EXPECT_EQ(unique, joined_pairs(volume));
}

TEST(Wireframe, CountsAsEulerSays) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(200, 2));
    const Wireframe wireframe = make_wireframe(volume.view());
    const size_t tetrahedra = volume.info.inner_cell_count;
    const size_t hull_faces = volume.cells.size() - tetrahedra;
    EXPECT_EQ(wireframe.hull_edges.size(), hull_faces * 3 / 2);
    // V − E + F − T = 1 for a filled ball, with F = (4 T + hull faces) / 2.
    const size_t faces = (4 * tetrahedra + hull_faces) / 2;
    EXPECT_EQ(200 + faces - tetrahedra - 1, all_edges(wireframe).size());
}

TEST(Wireframe, OfFlatSetsIsThatOfTheirCells) {
    const ProbeVolume square =
        test::make_lit_volume({{0, 0, 0}, {2, 0, 0}, {0, 0, 2}, {2, 0, 2}, {1, 0, 1}});
    EXPECT_EQ(make_wireframe(square.view()).hull_edges.size(), 4u);
    EXPECT_EQ(make_wireframe(square.view()).inner_edges.size(), 4u);
    const ProbeVolume line = test::make_lit_volume({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}});
    EXPECT_EQ(make_wireframe(line.view()).hull_edges.size(), 0u);
    EXPECT_EQ(make_wireframe(line.view()).inner_edges.size(), 2u);
    const ProbeVolume point = test::make_lit_volume({{1, 2, 3}});
    EXPECT_TRUE(all_edges(make_wireframe(point.view())).empty());
    EXPECT_EQ(make_wireframe(ProbeVolume{}.view()), Wireframe{});
}

TEST(Wireframe, StandsInTheWorldWithAndWithoutExactPositions) {
    ProbeVolume volume = test::make_lit_volume({{1e6, 0, 0}, {1e6 + 1, 0, 0}});
    const auto exact = make_wireframe(volume.view()).positions;
    EXPECT_EQ(exact, volume.exact_positions);
    volume.exact_positions.clear();
    EXPECT_EQ(make_wireframe(volume.view()).positions, exact);
}

TEST(Wireframe, ObjReadsBack) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(30, 3));
    const Wireframe wireframe = make_wireframe(volume.view());
    Wireframe read;
    std::vector<ProbeEdge>* edges = nullptr;
    std::istringstream lines(obj_text(wireframe));
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line.substr(1));
        glm::dvec3 p;
        ProbeEdge edge;
        std::string group;
        if (line[0] == 'v' && words >> p.x >> p.y >> p.z) read.positions.push_back(p);
        if (line[0] == 'g' && words >> group) {
            edges = group == "hull" ? &read.hull_edges : &read.inner_edges;
        }
        if (line[0] == 'l' && words >> edge[0] >> edge[1]) {
            edges->push_back({edge[0] - 1, edge[1] - 1});
        }
    }
    EXPECT_EQ(read, wireframe);
}

TEST(Wireframe, PlyReadsBack) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(30, 4));
    const Wireframe wireframe = make_wireframe(volume.view());
    std::istringstream words(ply_text(wireframe));
    size_t vertex_count = 0, edge_count = 0;
    for (std::string word; words >> word && word != "end_header";) {
        if (word == "vertex") words >> vertex_count;
        if (word == "edge") words >> edge_count;
    }
    Wireframe read;
    for (size_t i = 0; i < vertex_count; ++i) {
        glm::dvec3 p;
        words >> p.x >> p.y >> p.z;
        read.positions.push_back(p);
    }
    for (size_t i = 0; i < edge_count; ++i) {
        ProbeEdge edge;
        int is_hull = 0;
        words >> edge[0] >> edge[1] >> is_hull;
        (is_hull == 1 ? read.hull_edges : read.inner_edges).push_back(edge);
    }
    EXPECT_EQ(read, wireframe);
    EXPECT_FALSE(words >> vertex_count);  // nothing follows
}

}  // namespace
}  // namespace tetralight
