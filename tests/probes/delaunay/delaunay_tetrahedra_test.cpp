// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/delaunay/delaunay_tetrahedra.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "tests/probes/delaunay/delaunay_checks.h"
#include "tests/probes/delaunay/point_families.h"

namespace tetralight::test {
namespace {

using glm::dvec3;
using Points = std::vector<dvec3>;
using Vertices = std::vector<uint32_t>;

class Delaunay : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(All, Delaunay, testing::ValuesIn(kPointFamilies),
                         [](const auto& instance) { return std::string(instance.param); });

TEST_P(Delaunay, SpheresAreEmpty) {
    const Points points = make_points(GetParam(), 150, 1);
    const DelaunayTetrahedra delaunay = delaunay_of(points);
    expect_sound(delaunay);
    expect_delaunay(delaunay, points);
    std::set<uint32_t> vertices;
    for (const DelaunayCell& cell : delaunay.cells()) {
        if (cell.is_finite()) vertices.insert(cell.vertices.begin(), cell.vertices.end());
    }
    EXPECT_EQ(vertices.size(), points.size());
}

TEST_P(Delaunay, DoesNotDependOnTheOrder) {
    Points points = make_points(GetParam(), 700, 2);
    const auto expected = tetrahedra(delaunay_of(points));
    std::mt19937 random(3);
    for (int i = 0; i < 5; ++i) {
        std::ranges::shuffle(points, random);
        EXPECT_EQ(tetrahedra(delaunay_of(points)), expected);
    }
}

/// A set that changes, and what it should be.
struct Changing {
    Points points;
    Vertices vertices;
    std::vector<bool> is_in;
    DelaunayTetrahedra delaunay;

    explicit Changing(Points all) : points(std::move(all)) {
        vertices.resize(points.size());
        is_in.assign(points.size(), false);
    }

    void insert(const Vertices& indices) {
        Points added;
        for (const uint32_t i : indices) added.push_back(points[i]);
        Vertices numbers(added.size());
        ASSERT_TRUE(delaunay.insert(added, numbers));
        for (size_t k = 0; k < indices.size(); ++k) {
            vertices[indices[k]] = numbers[k];
            is_in[indices[k]] = true;
        }
    }

    void remove(const Vertices& indices) {
        Vertices removed;
        for (const uint32_t i : indices) {
            removed.push_back(vertices[i]);
            is_in[i] = false;
        }
        ASSERT_TRUE(delaunay.remove(removed));
    }

    /// The indices of points that are in the set, or not, and for which `choose` is true.
    template <class Choose>
    [[nodiscard]] Vertices those(bool in_set, const Choose& choose) const {
        Vertices indices;
        for (uint32_t i = 0; i < points.size(); ++i) {
            if (is_in[i] == in_set && choose(i)) indices.push_back(i);
        }
        return indices;
    }

    void expect_as_if_made_anew() const {
        Points left;
        for (const uint32_t i : those(true, [](uint32_t) { return true; }))
            left.push_back(points[i]);
        expect_sound(delaunay);
        EXPECT_EQ(tetrahedra(delaunay), tetrahedra(delaunay_of(left)));
    }
};

const auto kAll = [](uint32_t) { return true; };

TEST_P(Delaunay, IsAfterChangesAsIfMadeAnew) {
    std::mt19937 random(4);
    Changing set(make_points(GetParam(), 500, 5));
    set.insert(set.those(false, kAll));
    for (int step = 0; step < 12; ++step) {
        const dvec3 center = set.points[random() % set.points.size()];
        // In turn: one point, those near one, a tenth of all.
        const auto is_gone = [&](uint32_t i) {
            const dvec3 d = set.points[i] - center;
            if (step % 3 == 0) return set.points[i] == center;
            if (step % 3 == 1) return d.x * d.x + d.y * d.y + d.z * d.z < 0.3;
            return random() % 10 == 0;
        };
        set.remove(set.those(true, is_gone));
        set.expect_as_if_made_anew();
        set.insert(set.those(false, [&](uint32_t) { return random() % 2 == 0; }));
        set.expect_as_if_made_anew();
    }
}

TEST(DelaunayDimensions, BecomeSpaceAndFlatAgain) {
    // Four in a plane, of which three are on a line, and one above.
    Changing set({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0.5, 0.25, 1}, {0, 3, 0}});
    EXPECT_TRUE(set.delaunay.cells().empty());
    for (const uint32_t i : {0, 1, 2, 3}) {
        set.insert({i});
        EXPECT_TRUE(set.delaunay.cells().empty()) << i;
    }
    set.insert({4});
    EXPECT_EQ(tetrahedra(set.delaunay).size(), 2u);
    set.expect_as_if_made_anew();
    set.remove({4});
    EXPECT_TRUE(tetrahedra(set.delaunay).empty());
    set.insert({5});
    EXPECT_TRUE(tetrahedra(set.delaunay).empty());
    set.insert({4});
    set.expect_as_if_made_anew();
    set.remove({0, 1, 2, 3, 4, 5});
    EXPECT_TRUE(tetrahedra(set.delaunay).empty());
    set.insert({0, 3, 2, 4});
    EXPECT_EQ(tetrahedra(set.delaunay).size(), 1u);
}

TEST(DelaunayDimensions, OneVertexMayHaveAllOthersAround) {
    Points points = make_points("sphere", 3000, 6);
    points.emplace_back(0.0);
    Changing set(points);
    set.insert(set.those(false, kAll));
    expect_sound(set.delaunay);
    set.remove({3000});
    set.expect_as_if_made_anew();
}

TEST(DelaunayDimensions, NumbersOfRemovedVerticesAreUsedAgain) {
    Changing set(make_points("random", 100, 7));
    set.insert(set.those(false, kAll));
    EXPECT_EQ(set.delaunay.last_vertex(), 100u);
    set.remove({3, 50, 99});
    set.insert({3, 99});
    EXPECT_EQ(set.delaunay.last_vertex(), 100u);
    set.expect_as_if_made_anew();
}

}  // namespace
}  // namespace tetralight::test
