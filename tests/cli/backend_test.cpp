// SPDX-License-Identifier: Apache-2.0
// tetralight tetrahedralize --backend cgal|tetgen
#include <stdlib.h>

#include <tetralight/probes/probe_file.h>
#include "tests/cli/command_fixture.h"
#include "tests/support/fake_program.h"

namespace tetralight::test {
namespace {

struct Backend {
    const char* name;
    const char* variable;
};

void PrintTo(const Backend& backend, std::ostream* out) {
    *out << backend.name;
}

constexpr Backend kBackends[] = {{"cgal", "TETRALIGHT_CGAL"}, {"tetgen", "TETRALIGHT_TETGEN"}};

class BackendCommand : public CommandFixture, public testing::WithParamInterface<Backend> {
  protected:
    BackendCommand() {
        for (const Backend& backend : kBackends) ::unsetenv(backend.variable);
        write("five.json", kFiveProbes);
    }

    ~BackendCommand() override {
        for (const Backend& backend : kBackends) ::unsetenv(backend.variable);
    }

    static void use(const std::string& program) {
        ::setenv(GetParam().variable, program.c_str(), 1);
    }

    [[nodiscard]] static Arguments join(const std::string& groups, const std::string& output) {
        return {"tetrahedralize", groups, "-o", output, "--backend", GetParam().name};
    }

    [[nodiscard]] static std::string named_by_variable() {
        return std::string(" (") + GetParam().variable + " names the program)\n";
    }

    /// Holds that the command says this when the program is a script, and keeps the old volume.
    void fail_with(const std::string& commands, const std::string& message) const {
        use(programs_.script("fake", commands));
        EXPECT_EQ(fail_and_keep("old.probes", join("five.json", "old.probes")),
                  "tetralight: " + message + named_by_variable());
    }

    FakePrograms programs_;
};

INSTANTIATE_TEST_SUITE_P(All, BackendCommand, testing::ValuesIn(kBackends),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST_P(BackendCommand, MakesTheVolumeThatTheCommandMakesItself) {
    const Json json = run_json(join("five.json", "theirs.probes"));
    EXPECT_EQ(json["backend"], GetParam().name);
    EXPECT_EQ(json["inner_cells"], 4);
    succeed({"tetrahedralize", "five.json", "-o", "ours.probes"});
    const auto theirs = open_probe_file(path("theirs.probes"));
    const auto ours = open_probe_file(path("ours.probes"));
    ASSERT_TRUE(theirs && ours);
    EXPECT_TRUE(std::ranges::equal(theirs->view().cells, ours->view().cells));
    EXPECT_EQ(run_json({"info", "theirs.probes"})["made_with"]["backend"], GetParam().name);
    EXPECT_EQ(run_json({"info", "ours.probes"})["made_with"]["backend"], "tetralight");
}

TEST_P(BackendCommand, MakesAValidVolumeOfRegularGroups) {
    const Json json = run_json(join(kCourtyard, "court.probes"));
    EXPECT_EQ(json["probes"], 255);
    succeed({"validate", "court.probes"});
}

TEST_P(BackendCommand, TakesTheCommandsOwnProgramWhenTheVariableIsEmpty) {
    use("");
    succeed(join("five.json", "v.probes"));
}

TEST_P(BackendCommand, NeedsNoProgramForFlatGroups) {
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

TEST_P(BackendCommand, KeepsTheOldVolumeWhenTheProgramFails) {
    fail_with("kill -ABRT $$", "fake: ended by signal 6 (Aborted)");
    fail_with("echo 'two\nlines' >&2; kill -SEGV $$",
              "fake: ended by signal 11 (Segmentation fault): lines");
    fail_with("exit 0", "fake: its output ends after 0 bytes");
    fail_with("exec yes", "fake: its output has an unknown format or version");
    fail_with("printf '\\033[2J' >&2; exit 9", "fake: ended with exit code 9: \\u001b[2J");
}

TEST_P(BackendCommand, NamesAProgramThatIsNotThere) {
    use("/nowhere/program");
    EXPECT_EQ(fail_and_keep("old.probes", join("five.json", "old.probes")),
              "tetralight: program: cannot start /nowhere/program (No such file or directory)" +
                  named_by_variable());
}

TEST_P(BackendCommand, IsOneOfThree) {
    EXPECT_TRUE(contains(
        misuse({"tetrahedralize", "five.json", "-o", "v.probes", "--backend", "qhull"}), "qhull"));
}

}  // namespace
}  // namespace tetralight::test
