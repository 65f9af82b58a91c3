// SPDX-License-Identifier: Apache-2.0
// The programs themselves, on input that `tetrahedralize_with_program` never gives them.
#include <gtest/gtest.h>

#include <array>
#include <cstring>

#include <tetralight/base/error_text.h>
#include <tetralight/base/process/process.h>
#include <tetralight/probes/programs/stream.h>
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

using programs::StreamHeader;
using programs::StreamTetrahedron;

using Bytes = std::span<const std::byte>;

struct Program {
    std::string path;
    std::string name;
    /// The last words about positions that lie in a plane, if it is known what they are.
    std::string on_flat;
};

void PrintTo(const Program& program, std::ostream* out) {
    *out << program.name;
}

class ProgramMain : public testing::TestWithParam<Program> {
  protected:
    [[nodiscard]] static Result<std::vector<std::byte>> run(const StreamHeader& header,
                                                            std::span<const glm::dvec3> positions) {
        const std::array<Bytes, 2> input{std::as_bytes(std::span(&header, 1)),
                                         std::as_bytes(positions)};
        auto result = run_process(
            {.program = GetParam().path, .input = input, .time_limit = std::chrono::minutes(1)});
        if (!result) return result.error();
        if (!result->succeeded()) {
            return Error{ErrorCode::Unsupported,
                         result->failure() + ": " + result->last_error_line()};
        }
        return std::move(result->output);
    }

    [[nodiscard]] static Result<std::vector<std::byte>> run(std::span<const glm::dvec3> positions) {
        return run({programs::kPositionsMagic, positions.size()}, positions);
    }
};

TEST_P(ProgramMain, WritesOneTetrahedronPositivelyOriented) {
    const std::vector<glm::dvec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const auto output = run(positions);
    ASSERT_TRUE(output) << error_text(output.error());
    ASSERT_EQ(output->size(), sizeof(StreamHeader) + sizeof(StreamTetrahedron));
    StreamTetrahedron tetrahedron;
    std::memcpy(&tetrahedron, output->data() + sizeof(StreamHeader), sizeof tetrahedron);
    const auto& v = tetrahedron.vertices;
    const glm::dvec3& apex = positions[v[0]];
    EXPECT_GT(glm::dot(positions[v[1]] - apex,
                       glm::cross(positions[v[2]] - apex, positions[v[3]] - apex)),
              0.0);
    for (const uint32_t neighbor : tetrahedron.neighbors) {
        EXPECT_EQ(neighbor, programs::kStreamNoNeighbor);
    }
}

TEST_P(ProgramMain, RefusesInputThatIsNoPositions) {
    const std::string prefix = "ended with exit code 1: " + GetParam().name + ": ";
    const auto positions = test::random_positions(10, 1);
    EXPECT_EQ(error_text(run({}, {}).error()), prefix + "stdin holds no positions of this version");
    EXPECT_EQ(error_text(run({programs::kPositionsMagic, 11}, positions).error()),
              prefix + "stdin ends within the positions");
    EXPECT_EQ(error_text(run({programs::kPositionsMagic, uint64_t{1} << 25}, positions).error()),
              prefix + "stdin ends within the positions");
    EXPECT_EQ(error_text(run({programs::kPositionsMagic, uint64_t{1} << 62}, positions).error()),
              prefix + "too many positions");
}

TEST_P(ProgramMain, EndsWithAnErrorOnFlatPositions) {
    const auto flat = [](const glm::dvec3& scale) {
        auto positions = test::random_positions(20, 1);
        for (glm::dvec3& p : positions) p *= scale;
        return positions;
    };
    for (const auto& positions : {flat({1, 1, 0}), flat({1, 0, 0}), flat({0, 0, 0}),
                                  test::random_positions(0, 1), test::random_positions(1, 1),
                                  test::random_positions(2, 1), test::random_positions(3, 1)}) {
        const auto output = run(positions);
        ASSERT_FALSE(output) << positions.size();
        const std::string error = error_text(output.error());
        EXPECT_TRUE(error.starts_with("ended ") && error.ends_with(GetParam().on_flat)) << error;
    }
}

INSTANTIATE_TEST_SUITE_P(
    All, ProgramMain,
    testing::Values(Program{TETRALIGHT_CGAL_PROGRAM, "tetralight-cgal",
                            ": tetralight-cgal: the positions are flat"},
                    Program{TETRALIGHT_TETGEN_PROGRAM, "tetralight-tetgen", ""}),
    [](const auto& instance) { return instance.param.on_flat.empty() ? "Tetgen" : "Cgal"; });

}  // namespace
}  // namespace tetralight
