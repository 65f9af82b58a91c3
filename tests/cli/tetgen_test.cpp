// SPDX-License-Identifier: Apache-2.0
// tetralight tetrahedralize --backend tetgen
#include <stdlib.h>

#include <tetralight/probes/probe_file.h>
#include "tests/cli/command_fixture.h"
#include "tests/support/fake_program.h"

namespace tetralight::test {
namespace {

class TetgenBackend : public CommandFixture {
  protected:
    TetgenBackend() {
        ::unsetenv("TETRALIGHT_TETGEN");
        write("five.json", kFiveProbes);
    }

    ~TetgenBackend() override { ::unsetenv("TETRALIGHT_TETGEN"); }

    static void use(const std::string& program) {
        ::setenv("TETRALIGHT_TETGEN", program.c_str(), 1);
    }

    [[nodiscard]] static Arguments join(const std::string& groups, const std::string& output) {
        return {"tetrahedralize", groups, "-o", output, "--backend", "tetgen"};
    }

    /// Holds that the command says this when the program is a script, and keeps the old volume.
    void fail_with(const std::string& commands, const std::string& message) const {
        use(programs_.script("fake", commands));
        EXPECT_EQ(fail_and_keep("old.probes", join("five.json", "old.probes")),
                  "tetralight: " + message + " (TETRALIGHT_TETGEN names the program)\n");
    }

    FakePrograms programs_;
};

TEST_F(TetgenBackend, MakesTheVolumeThatCgalMakes) {
    const Json json = run_json(join("five.json", "tetgen.probes"));
    EXPECT_EQ(json["backend"], "tetgen");
    EXPECT_EQ(json["inner_cells"], 4);
    succeed({"tetrahedralize", "five.json", "-o", "cgal.probes"});
    const auto tetgen = open_probe_file(path("tetgen.probes"));
    const auto cgal = open_probe_file(path("cgal.probes"));
    ASSERT_TRUE(tetgen && cgal);
    EXPECT_TRUE(std::ranges::equal(tetgen->view().cells, cgal->view().cells));
    EXPECT_EQ(run_json({"info", "tetgen.probes"})["made_with"]["backend"], "tetgen");
    EXPECT_EQ(run_json({"info", "cgal.probes"})["made_with"]["backend"], "cgal");
}

TEST_F(TetgenBackend, MakesAValidVolumeOfRegularGroups) {
    const Json json = run_json(join(kCourtyard, "court.probes"));
    EXPECT_EQ(json["probes"], 255);
    succeed({"validate", "court.probes"});
}

TEST_F(TetgenBackend, TakesTheCommandsOwnProgramWhenTheVariableIsEmpty) {
    use("");
    succeed(join("five.json", "v.probes"));
}

TEST_F(TetgenBackend, NeedsNoProgramForFlatGroups) {
    use("/nowhere/program");
    const std::pair<const char*, const char*> kSets[] = {
        {"point", "[[1, 2, 3]]"},
        {"line", "[[1, 2, 3], [4, 5, 6]]"},
        {"plane", "[[1, 2, 3], [4, 5, 6], [0, 1, 0]]"},
        {"line", "[[0, 0, 0], [1, 0, 0], [2, 0, 0], [7, 0, 0], [9, 0, 0]]"},
        {"plane", "[[0, 1, 0], [4, 1, 0], [0, 1, 4], [4, 1, 4], [1, 1, 2]]"}};
    for (const auto& [dimension, positions] : kSets) {
        write("flat.json",
              std::string(R"({"groups": [{"name": "flat", "positions": )") + positions + "}]}");
        EXPECT_EQ(run_json(join("flat.json", "flat.probes"))["dimension"], dimension);
        succeed({"validate", "flat.probes"});
    }
}

TEST_F(TetgenBackend, KeepsTheOldVolumeWhenTheProgramFails) {
    fail_with("kill -ABRT $$", "fake: ended by signal 6 (Aborted)");
    fail_with("echo 'two\nlines' >&2; kill -SEGV $$",
              "fake: ended by signal 11 (Segmentation fault): lines");
    fail_with("exit 0", "fake: its output ends after 0 bytes");
    fail_with("exec yes", "fake: its output has an unknown format or version");
    fail_with("printf '\\033[2J' >&2; exit 9", "fake: ended with exit code 9: \\u001b[2J");
}

TEST_F(TetgenBackend, NamesAProgramThatIsNotThere) {
    use("/nowhere/program");
    EXPECT_EQ(fail_and_keep("old.probes", join("five.json", "old.probes")),
              "tetralight: program: cannot start /nowhere/program (No such file or directory) "
              "(TETRALIGHT_TETGEN names the program)\n");
}

TEST_F(TetgenBackend, IsOneOfTwo) {
    EXPECT_TRUE(contains(
        misuse({"tetrahedralize", "five.json", "-o", "v.probes", "--backend", "qhull"}), "qhull"));
}

}  // namespace
}  // namespace tetralight::test
