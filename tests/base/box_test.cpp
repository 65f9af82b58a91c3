// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/box.h>

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>

namespace tetralight {
namespace {

using TestBox = Box<glm::dvec3>;

TEST(Box, HasACenterAndASize) {
    const TestBox box{{-1, 0, 2}, {3, 4, 2}};
    EXPECT_EQ(box.center(), glm::dvec3(1, 2, 2));
    EXPECT_EQ(box.size(), glm::dvec3(4, 4, 0));
}

TEST(Box, UnionContainsBothBoxes) {
    const TestBox a{{0, 0, 0}, {1, 1, 1}}, b{{-1, 0.5, 0}, {0, 2, 1}};
    EXPECT_EQ(union_of(a, b), (TestBox{{-1, 0, 0}, {1, 2, 1}}));
    EXPECT_EQ(union_of(a, glm::dvec3(3, 0, -1)), (TestBox{{0, 0, -1}, {3, 1, 1}}));
}

TEST(Box, UnionWithTheEmptyBoxIsTheOther) {
    const TestBox a{{0, 0, 0}, {1, 2, 3}};
    EXPECT_EQ(union_of(TestBox::empty(), a), a);
    EXPECT_FALSE(contains(TestBox::empty(), glm::dvec3(0.0)));
}

TEST(Box, IntersectionOfDisjointBoxesIsReversed) {
    const TestBox a{{0, 0, 0}, {2, 2, 2}}, b{{1, 1, 1}, {3, 3, 3}}, far{{5, 0, 0}, {6, 1, 1}};
    EXPECT_EQ(intersection_of(a, b), (TestBox{{1, 1, 1}, {2, 2, 2}}));
    EXPECT_GT(intersection_of(a, far).min.x, intersection_of(a, far).max.x);
}

TEST(Box, ContainsItsCornersAndNothingOutside) {
    const TestBox box{{0, 0, 0}, {1, 1, 1}};
    EXPECT_TRUE(contains(box, box.min));
    EXPECT_TRUE(contains(box, box.max));
    EXPECT_FALSE(contains(box, glm::dvec3(0.5, 0.5, 1.5)));
}

}  // namespace
}  // namespace tetralight
