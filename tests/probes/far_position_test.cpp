// SPDX-License-Identifier: Apache-2.0
// Every finite position has a cell and finite light, however far away and whatever the probes.
#include <gtest/gtest.h>

#include <cmath>

#include <tetralight/probes/interpolate.h>
#include "tests/support/probe_families.h"

namespace tetralight {
namespace {

/// Along the axes, the diagonals, and the normal and the axis of flat sets.
std::vector<glm::dvec3> directions(const ProbeVolume& volume) {
    std::vector<glm::dvec3> result;
    for (int code = 0; code < 27; ++code) {
        const glm::dvec3 d(code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1);
        if (code != 13) result.push_back(glm::normalize(d));
    }
    if (volume.info.axis != glm::dvec3(0.0)) {
        result.push_back(volume.info.axis);
        result.push_back(-volume.info.axis);
    }
    return result;
}

std::vector<std::vector<glm::dvec3>> sets() {
    const auto mixed = [] {
        auto positions = test::random_positions(500, 3);
        for (size_t i = 0; i < positions.size(); ++i) {
            positions[i] *= std::pow(10.0, static_cast<double>(i % 7) - 3.0);
        }
        return positions;
    };
    const auto cube = test::random_positions(300, 1, 50.0);
    const auto square = test::moved(cube, {1, 1, 0}, {});
    return {test::random_positions(1, 1),
            test::moved(test::random_positions(80, 2), {1, 0, 0}, {}),
            test::turned(test::moved(test::random_positions(1000, 2), {1, 1, 0}, {}), 0.7),
            test::random_positions(1000, 2),
            test::moved(test::random_positions(500, 4), {1, 1, 1e-4}, {}),
            test::moved(test::random_positions(500, 5), {1, 1e-3, 1e-3}, {}),
            test::moved(test::random_positions(500, 6), glm::dvec3(1), {1e5, -1e5, 1e5}),
            mixed(),
            test::far_clusters(1),
            test::joined(cube, {{1e9, 1e8, -3e8}}),
            test::joined(cube, {{1e8, 1e8, 1e8}}),
            test::joined(cube, {{1e12, 3e11, -2e11}}),
            test::joined(square, {{1e9, 1e8, 0}})};
}

TEST(FarPositions, HaveACellAndFiniteLight) {
    for (const auto& positions : sets()) {
        const ProbeVolume volume = test::make_lit_volume(positions);
        const ProbeVolumeView view = volume.view();
        for (int exponent = 0; exponent <= 39; ++exponent) {
            const double distance = exponent == 39 ? 3e38 : std::pow(10.0, exponent);
            for (const glm::dvec3& direction : directions(volume)) {
                const glm::vec3 p(distance * direction);
                const LocationTrace trace = trace_location(view, p);
                const CellLocation& location = trace.location;
                ASSERT_FALSE(trace.is_fallback) << positions.size() << " " << distance;
                ASSERT_LT(location.cell, volume.cells.size())
                    << positions.size() << " " << distance;
                const glm::vec4 w = location.weights;
                ASSERT_NEAR(w.x + w.y + w.z + w.w, 1.0f, 1e-5f);
                const glm::vec3 light = interpolate(view, location).irradiance.coefficients[0];
                ASSERT_TRUE(std::isfinite(light.x + light.y + light.z));
            }
        }
    }
}

TEST(FarPositions, HaveACellNearTheProbesOfASetWithAnOutlier) {
    const auto cube = test::random_positions(300, 1, 50.0);
    const ProbeVolume volume = test::make_lit_volume(test::joined(cube, {{1e9, 1e8, -3e8}}));
    for (const glm::dvec3& p : test::random_positions(500, 2, 60.0)) {
        const LocationTrace trace = trace_location(volume.view(), glm::vec3(p));
        ASSERT_LT(trace.location.cell, volume.cells.size());
        ASSERT_FALSE(trace.is_fallback);
    }
}

}  // namespace
}  // namespace tetralight
