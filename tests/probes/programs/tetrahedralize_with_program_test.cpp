// SPDX-License-Identifier: Apache-2.0
// What happens when the program behaves badly: it is a shell script here. How CGAL's and
// TetGen's do is in families_test.cpp.
#include <tetralight/probes/programs/tetrahedralize_with_program.h>

#include <gtest/gtest.h>

#include <algorithm>

#include <tetralight/base/error_text.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/probes/build/detail/delaunay.h>
#include <tetralight/probes/programs/stream.h>
#include "tests/support/fake_program.h"
#include "tests/support/probe_families.h"

namespace tetralight {
namespace {

using programs::StreamHeader;

std::vector<std::byte> bytes_of(const StreamHeader& header, std::span<const Cell> cells) {
    const auto head = std::as_bytes(std::span(&header, 1));
    const auto body = std::as_bytes(cells);
    std::vector<std::byte> bytes(head.size() + body.size());
    std::ranges::copy(body, std::ranges::copy(head, bytes.begin()).out);
    return bytes;
}

std::vector<std::byte> bytes_of(std::span<const Cell> cells) {
    return bytes_of({programs::kTetrahedraMagic, cells.size()}, cells);
}

class Program : public testing::Test {
  protected:
    static std::string error(const std::string& program) {
        const auto result = tetrahedralize_with_program(kPositions, 0.0, {program});
        EXPECT_FALSE(result);
        return result ? "" : error_text(result.error());
    }

    [[nodiscard]] std::string script_error(const std::string& commands) const {
        return error(programs_.script("fake", commands));
    }

    [[nodiscard]] std::string output_error(std::span<const std::byte> bytes) const {
        return error(programs_.writer("fake", bytes));
    }

    inline static const std::vector<glm::dvec3> kPositions = test::random_positions(300, 1);
    inline static const std::vector<Cell> kCells = detail::delaunay_tetrahedra(kPositions);

    test::FakePrograms programs_;
};

TEST_F(Program, TakesTheCellsOfTheProgram) {
    const auto result =
        tetrahedralize_with_program(kPositions, 0.0, {programs_.writer("fake", bytes_of(kCells))});
    ASSERT_TRUE(result) << error_text(result.error());
    EXPECT_EQ(*result, tetrahedralize(kPositions));
}

TEST_F(Program, GivesTheProgramTheExactPositions) {
    StreamHeader header{programs::kPositionsMagic, kPositions.size()};
    std::string expected(reinterpret_cast<const char*>(&header), sizeof header);
    expected.append(reinterpret_cast<const char*>(kPositions.data()),
                    kPositions.size() * sizeof(glm::dvec3));
    EXPECT_EQ(script_error("cat > \"$0.in\""), "fake: its output ends after 0 bytes");
    const auto seen = read_file(programs_.path("fake.in"));
    ASSERT_TRUE(seen);
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(seen->data()), seen->size()), expected);
}

TEST_F(Program, SurvivesAProgramThatCrashes) {
    EXPECT_EQ(script_error("kill -ABRT $$"), "fake: ended by signal 6 (Aborted)");
    EXPECT_EQ(script_error("cat >/dev/null; kill -SEGV $$"),
              "fake: ended by signal 11 (Segmentation fault)");
    const auto half = std::span(kCells).first(kCells.size() / 2);
    const auto bytes = bytes_of({programs::kTetrahedraMagic, kCells.size()}, half);
    EXPECT_EQ(error(programs_.writer("fake", bytes, "kill -BUS $$")),
              "fake: ended by signal 7 (Bus error)");
}

TEST_F(Program, SurvivesAProgramThatFails) {
    EXPECT_EQ(script_error("echo 'fake: no luck' >&2; exit 1"),
              "fake: ended with exit code 1: no luck");
    // Even with good output: the program says itself that it failed.
    EXPECT_EQ(error(programs_.writer("fake", bytes_of(kCells), "exit 4")),
              "fake: ended with exit code 4");
}

TEST_F(Program, SurvivesAProgramThatIsNotThere) {
    EXPECT_EQ(
        error("/nowhere/tetralight-tetgen"),
        "tetralight-tetgen: cannot start /nowhere/tetralight-tetgen (No such file or directory)");
}

TEST_F(Program, SurvivesAProgramThatHangs) {
    const TetrahedraProgram program{programs_.script("fake", "exec sleep 50"),
                                    std::chrono::milliseconds(100)};
    EXPECT_EQ(error_text(tetrahedralize_with_program(kPositions, 0.0, program).error()),
              "fake: did not end within 0.1 s");
}

TEST_F(Program, RefusesGarbage) {
    const std::string message = "fake: its output has an unknown format or version";
    EXPECT_EQ(script_error("echo hello"), message);
    EXPECT_EQ(script_error("exec yes"), message);
    EXPECT_EQ(script_error("head -c 100000 /dev/zero"), message);
    EXPECT_EQ(script_error("cat"), message);  // the positions
}

TEST_F(Program, RefusesOutputThatIsTooShort) {
    EXPECT_EQ(script_error("exit 0"), "fake: its output ends after 0 bytes");
    std::vector<std::byte> bytes = bytes_of(kCells);
    const std::string of_all = str_cat(" of ", kCells.size(), " tetrahedra");
    bytes.pop_back();
    EXPECT_EQ(output_error(bytes),
              str_cat("fake: its output ends after ", kCells.size() - 1, of_all));
    EXPECT_EQ(output_error(std::span(bytes).first(16)), "fake: its output ends after 0" + of_all);
    EXPECT_EQ(output_error(std::span(bytes).first(15)), "fake: its output ends after 15 bytes");
    EXPECT_EQ(output_error(std::span(bytes).first(3)), "fake: its output ends after 3 bytes");
}

TEST_F(Program, RefusesOutputThatGoesOn) {
    const std::string message =
        str_cat("fake: its output is longer than its ", kCells.size(), " tetrahedra");
    EXPECT_EQ(error(programs_.writer("fake", bytes_of(kCells), "echo")), message);
    EXPECT_EQ(error(programs_.writer("fake", bytes_of(kCells), "exec cat /dev/zero")), message);
}

TEST_F(Program, RefusesMoreTetrahedraThanThereCanBe) {
    for (const uint64_t count : {uint64_t{44'551}, uint64_t{1} << 59, ~uint64_t{0}}) {
        EXPECT_EQ(output_error(bytes_of({programs::kTetrahedraMagic, count}, kCells)),
                  str_cat("fake: its output has ", count,
                          " tetrahedra over 300 probes: more than there can be"));
    }
}

TEST_F(Program, RefusesIndicesOutOfRange) {
    std::vector<Cell> cells = kCells;
    cells[9].vertices[3] = 300;
    EXPECT_EQ(output_error(bytes_of(cells)),
              "fake: tetrahedron 9: vertex 300 is out of range (300)");
}

TEST_F(Program, RefusesCellsThatLeaveProbesOut) {
    // What a program that drops the last two positions would write.
    const auto some = detail::delaunay_tetrahedra(std::span(kPositions).first(298));
    EXPECT_EQ(output_error(bytes_of(some)), "fake: left out 2 of 300 probes");
    EXPECT_EQ(output_error(bytes_of({})), "fake: left out 300 of 300 probes");
}

TEST_F(Program, RefusesCellsOfOtherPositions) {
    const auto other = detail::delaunay_tetrahedra(test::random_positions(300, 2));
    EXPECT_TRUE(output_error(bytes_of(other)).starts_with("fake: "));
}

TEST_F(Program, NeverSeesFlatSets) {
    const TetrahedraProgram none{"/nowhere/program"};
    std::vector<std::vector<glm::dvec3>> sets{
        {},
        test::random_positions(1, 1),
        test::random_positions(2, 1),
        test::random_positions(3, 1),
        test::moved(test::random_positions(200, 1), {1, 0, 1}, {0, 3, 0}),
        test::turned(test::moved(test::random_positions(200, 1), {1, 1, 0}, {}), 1.0),
        test::moved(test::random_positions(50, 1), {1, 0, 0}, {0, 1, 2}),
        std::vector<glm::dvec3>(5, glm::dvec3(1, 2, 3))};
    for (const auto& positions : sets) {
        const auto result = tetrahedralize_with_program(positions, 0.0, none);
        ASSERT_TRUE(result) << error_text(result.error());
        EXPECT_EQ(*result, tetrahedralize(positions));
    }
    const auto thin = test::moved(test::random_positions(200, 1), {1, 1, 1e-3}, {});
    EXPECT_TRUE(tetrahedralize_with_program(thin, 1e-2, none));
    EXPECT_FALSE(tetrahedralize_with_program(thin, 1e-4, none));
}

}  // namespace
}  // namespace tetralight
