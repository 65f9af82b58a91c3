// SPDX-License-Identifier: Apache-2.0
// The shader's query, compiled as C++, against the queries of the CPU.
#include <tetralight/runtime/shader_query.h>

#include <gtest/gtest.h>

#include <algorithm>

#include <tetralight/probes/interpolate.h>
#include "tests/runtime/shader_query_cases.h"

namespace tetralight {
namespace {

class ShaderQuery : public testing::TestWithParam<test::ShaderQueryCase> {};

TEST_P(ShaderQuery, AnswersAsTheCpuDoes) {
    const test::ShaderQueryVolume subject(GetParam());
    const ShaderVolume shader = make_shader_volume(subject.volume.view());
    for (const glm::vec3& position : subject.make_positions(5000)) {
        const PackedProbe probe = interpolate(shader, locate(shader, position));
        test::expect_cpu_answer(subject.volume.view(), position, probe);
        if (HasFailure()) return;
    }
}

TEST_P(ShaderQuery, AnswersTheSameFromEveryHint) {
    const test::ShaderQueryVolume subject(GetParam());
    const ShaderVolume shader = make_shader_volume(subject.volume.view());
    std::mt19937_64 engine(9);
    for (const glm::vec3& position : subject.make_positions(1000)) {
        const auto hint = static_cast<uint32_t>(engine() % (2 * shader.cells.size()));
        const PackedProbe probe = interpolate(shader, locate(shader, position, hint));
        test::expect_cpu_answer(subject.volume.view(), position, probe);
        if (HasFailure()) return;
    }
}

TEST_P(ShaderQuery, AnswersAsSomeCellWhereCellsMeet) {
    const test::ShaderQueryVolume subject(GetParam());
    const ShaderVolume shader = make_shader_volume(subject.volume.view());
    for (const glm::vec3& position : subject.make_edge_middles(5000)) {
        const CellLocation location = locate(shader, position);
        test::expect_answer_of_a_cell(subject.volume.view(), position, location,
                                      interpolate(shader, location));
        if (HasFailure()) return;
    }
}

TEST_P(ShaderQuery, WeightsArePositiveAndSumToOne) {
    const test::ShaderQueryVolume subject(GetParam());
    const ShaderVolume shader = make_shader_volume(subject.volume.view());
    for (const glm::vec3& position : subject.make_positions(1000)) {
        const CellLocation location = locate(shader, position);
        ASSERT_LT(location.cell, shader.cells.size());
        const glm::vec4 w = location.weights;
        EXPECT_GE(std::min({w.x, w.y, w.z, w.w}), 0.0f);
        EXPECT_NEAR(w.x + w.y + w.z + w.w, 1.0f, 1e-6f);
    }
}

INSTANTIATE_TEST_SUITE_P(Volumes, ShaderQuery, testing::ValuesIn(test::shader_query_cases()),
                         [](const auto& param) { return param.param.family; });

TEST(ShaderQuery, PositionsThatAreNotFiniteGetTheAmbientLight) {
    const test::ShaderQueryVolume subject({"random", 100});
    const ShaderVolume shader = make_shader_volume(subject.volume.view());
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (const glm::vec3& position : {glm::vec3(kNan, 0, 0), glm::vec3(0, kInfinity, 0),
                                      glm::vec3(0, 0, -kInfinity), glm::vec3(kNan)}) {
        EXPECT_EQ(locate(shader, position).cell, kNoIndex);
    }
}

TEST(ShaderQuery, FarAwayOnlyTheDirectionCounts) {
    const test::ShaderQueryVolume subject({"random", 500});
    const ShaderVolume shader = make_shader_volume(subject.volume.view());
    std::mt19937_64 engine(4);
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 direction = test::random_direction(engine);
        for (const float distance : {10.0f, 1000.0f, 1e6f, 1e12f, 1e30f, 2e38f}) {
            const PackedProbe probe = interpolate(shader, locate(shader, distance * direction));
            test::expect_cpu_answer(subject.volume.view(), distance * direction, probe);
        }
    }
}

}  // namespace
}  // namespace tetralight
