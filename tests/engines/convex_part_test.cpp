// SPDX-License-Identifier: Apache-2.0
#include <tetralight/engines/detail/convex_part.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

using detail::ConvexPart;
using detail::CutPlane;

/// Six times the volume: tetrahedra between a point and the triangles of each face.
double volume_of(const ConvexPart& part) {
    double volume = 0.0;
    for (size_t at = 0; at < part.faces.size(); at += part.faces[at] + 1) {
        const auto point = [&](size_t i) { return part.points[part.faces[at + 1 + i]]; };
        for (size_t i = 2; i < part.faces[at]; ++i) {
            volume += glm::dot(point(0) - part.points[0], glm::cross(point(i - 1) - part.points[0],
                                                                     point(i) - part.points[0]));
        }
    }
    return volume;
}

/// Euler's formula holds, and each edge has two faces.
void expect_closed(const ConvexPart& part) {
    size_t face_count = 0;
    size_t corner_count = 0;
    for (size_t at = 0; at < part.faces.size(); at += part.faces[at] + 1) {
        ++face_count;
        corner_count += part.faces[at];
    }
    EXPECT_EQ(corner_count % 2, 0u);
    EXPECT_EQ(part.points.size() + face_count, corner_count / 2 + 2);
}

TEST(ConvexPart, BothSidesOfACutAreClosedAndMakeUpThePart) {
    std::mt19937_64 engine(1);
    for (int round = 0; round < 200; ++round) {
        const auto corners = test::random_positions(4, static_cast<uint64_t>(round));
        ConvexPart part = detail::convex_part({corners[0], corners[1], corners[2], corners[3]});
        for (int i = 0; i < 6; ++i) {
            glm::dvec3 center(0.0);
            for (const glm::dvec3& p : part.points) {
                center += p / static_cast<double>(part.points.size());
            }
            const glm::vec3 normal = test::random_direction(engine);
            const CutPlane plane{normal, glm::dot(normal, glm::vec3(center))};
            const ConvexPart over = cut(part, plane, detail::Side::Over);
            const ConvexPart under = cut(part, plane, detail::Side::Under);
            expect_closed(over);
            expect_closed(under);
            EXPECT_NEAR(volume_of(over) + volume_of(under), volume_of(part), 1e-9);
            part = i % 2 == 0 ? over : under;
        }
    }
}

/// Through an edge and the middle of the opposite one: two tetrahedra of half the size.
TEST(ConvexPart, PlanesThroughPointsOfThePartKeepThem) {
    const ConvexPart part = detail::convex_part(
        {glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)});
    const float d = 0.70710678f;
    const CutPlane plane{{d, -d, 0.0f}, 0.0f};
    for (const auto side : {detail::Side::Over, detail::Side::Under}) {
        const ConvexPart half = cut(part, plane, side);
        EXPECT_EQ(half.points.size(), 4u);
        expect_closed(half);
        EXPECT_NEAR(volume_of(half), 0.5, 1e-6);
    }
}

}  // namespace
}  // namespace tetralight
