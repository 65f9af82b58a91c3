// SPDX-License-Identifier: Apache-2.0
// The shader's query, compiled as C++, against the queries of the CPU.
#include <tetralight/runtime/shader_query.h>

#include <gtest/gtest.h>

#include <algorithm>

#include <tetralight/probes/build/make_seeds.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/seed_grid.h>
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

TEST_P(ShaderQuery, HidesProbesBehindWallsWithTheWeightsOfTheCpu) {
    test::ShaderQueryVolume subject(GetParam());
    subject.add_random_walls();
    const ProbeVolumeView view = subject.volume.view();
    const ShaderVolume shader = make_shader_volume(view);
    size_t hidden_count = 0;
    for (const glm::vec3& position : subject.make_positions(5000)) {
        const CellLocation location = locate(shader, position);
        const CellLocation visible = visible_location(shader, location);
        EXPECT_EQ(visible, visible_location(view, location));
        hidden_count += visible.weights != location.weights;
        const PackedProbe probe = interpolate(shader, location);
        EXPECT_EQ(probe, interpolate(shader, visible, Walls::Ignore));
        const InterpolatedProbe cpu = interpolate(view, location);
        EXPECT_LE(test::difference(probe, {pack_sh(cpu.irradiance), cpu.occlusion}), 1e-5f);
        if (HasFailure()) return;
    }
    EXPECT_EQ(hidden_count > 1000, subject.volume.info.dimension > Dimension::Point);
}

TEST_P(ShaderQuery, PushesPositionsOffSurfacesAsTheCpuDoes) {
    const test::ShaderQueryVolume subject(GetParam());
    const ProbeVolumeView view = subject.volume.view();
    const ShaderVolume shader = make_shader_volume(view);
    const glm::vec3 normal(0, 1, 0);
    for (const glm::vec3& position : subject.make_positions(1000)) {
        const CellLocation location = locate(shader, position);
        const glm::vec3 gpu = push_off_surface(shader, position, normal, location);
        const glm::vec3 cpu = push_off_surface(view, position, normal, location);
        const float rounding = 1e-6f * (view.info.extent + glm::length(position));
        EXPECT_LE(glm::distance(gpu, cpu), rounding);
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

TEST(ShaderQuery, AnswersAsTheCpuDoesWithoutASeedGrid) {
    test::ShaderQueryVolume subject({"random", 2000});
    subject.volume.seed_grid.clear();  // as in files of older versions
    make_seeds(subject.volume);
    const ShaderVolume shader = make_shader_volume(subject.volume.view());
    for (const glm::vec3& position : subject.make_positions(5000)) {
        const PackedProbe probe = interpolate(shader, locate(shader, position));
        test::expect_cpu_answer(subject.volume.view(), position, probe);
    }
}

TEST(ShaderQuery, StartsAtTheCellThatTheSeedGridNames) {
    const test::ShaderQueryVolume subject({"clusters", 2000});  // grids inside each other
    const std::vector<uint32_t>& words = subject.volume.seed_grid;
    const ShaderVolume shader = make_shader_volume(subject.volume.view());
    size_t finer_count = 0;
    for (const glm::vec3& local : subject.make_seed_positions(5000)) {
        EXPECT_EQ(seed_cell(shader, local), words[find_seed_word(words, local)]);
        const uint64_t outer = seed_word(seed_grid_header(words, 0), 0, local);
        finer_count += (words[outer] & kFinerGrid) != 0;
    }
    EXPECT_GT(finer_count, 1000u);
}

TEST(ShaderQuery, StartsAtSomeCellIfTheSeedGridIsCorrupt) {
    const test::ShaderQueryVolume subject({"clusters", 500});
    const auto positions = subject.make_seed_positions(100);
    std::mt19937_64 engine(5);
    for (int i = 0; i < 300; ++i) {
        ProbeVolume volume = subject.volume;
        if (engine() % 2) volume.seed_grid.resize(engine() % 40);
        const size_t count = volume.seed_grid.size();
        for (int k = 0; k < 20 && count > 0; ++k) {
            const size_t word = engine() % std::min<size_t>(count, engine() % 2 ? count : 16);
            volume.seed_grid[word] = static_cast<uint32_t>(engine() >> (engine() % 64));
        }
        const ShaderVolume shader = make_shader_volume(volume.view());
        for (const glm::vec3& local : positions) {
            EXPECT_LT(seed_cell(shader, local), volume.cells.size());
        }
    }
}

TEST(ShaderQuery, AnswersAsTheCpuDoesInTwoRooms) {
    test::ShaderQueryVolume subject({"lattice", 1728});
    const auto& probes = subject.volume.exact_positions;
    const auto [low, high] = std::ranges::minmax(probes, {}, &glm::dvec3::x);
    subject.add_wall(0.5 * (low.x + high.x));  // between two layers of probes
    const ProbeVolumeView view = subject.volume.view();
    const ShaderVolume shader = make_shader_volume(view);
    size_t hidden_count = 0;
    for (const glm::vec3& position : subject.make_positions(20'000)) {
        const CellLocation location = locate(shader, position);
        test::expect_cpu_answer(view, position, interpolate(shader, location));
        hidden_count += visible_location(shader, location) != location;
    }
    EXPECT_GT(hidden_count, 500u);
}

TEST(ShaderQuery, WithoutWallsWeightsAreAsTheyAreToTheBit) {
    test::ShaderQueryVolume subject({"random", 500});
    const ShaderVolume plain = make_shader_volume(subject.volume.view());
    subject.add_random_walls();
    const ShaderVolume walled = make_shader_volume(subject.volume.view());
    ShaderVolume without = walled;
    without.constants.walls = glm::uvec4(0);
    for (const glm::vec3& position : subject.make_positions(1000)) {
        const CellLocation location = locate(plain, position);
        const PackedProbe probe = interpolate(plain, location);
        EXPECT_EQ(visible_location(plain, location), location);
        EXPECT_EQ(interpolate(without, location), probe);
        EXPECT_EQ(interpolate(walled, location, Walls::Ignore), probe);
    }
}

TEST(ShaderQuery, ReadsWallsOfCorruptFilesAsTheCpuDoes) {
    test::ShaderQueryVolume subject({"random", 500});
    subject.add_random_walls();
    std::mt19937_64 engine(7);
    for (int i = 0; i < 300; ++i) {
        ProbeVolume volume = subject.volume;
        volume.cell_visibility.resize(engine() % 40);
        if (engine() % 2) volume.visibility_blocks.resize(engine() % 200);
        for (VisibilityBlock& block : volume.visibility_blocks) {
            if (engine() % 2) block.first = static_cast<uint32_t>(engine() >> (32 + engine() % 32));
            if (engine() % 2) block.cells = static_cast<uint32_t>(engine());
        }
        const ShaderVolume shader = make_shader_volume(volume.view());
        for (int k = 0; k < 100; ++k) {
            const auto cell = static_cast<uint32_t>(engine() % volume.cells.size());
            const CellLocation location{cell, 0.0f, {0.125f, 0.25f, 0.5f, 0.125f}};
            EXPECT_EQ(visible_location(shader, location),
                      visible_location(volume.view(), location));
        }
        EXPECT_EQ(visible_location(shader, {}), CellLocation{});
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
