// SPDX-License-Identifier: Apache-2.0
// What the subcommands that write a file have in common.
#include <sys/stat.h>

#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

/// Commands that write a file, with sound input beside them.
class EveryWriter : public CommandFixture, public testing::WithParamInterface<const char*> {
  protected:
    EveryWriter() {
        if (reads_volume()) bake_courtyard("v.probes");
        write("empty.gltf", kEmptyScene);
        write("five.json", kFiveProbes);
        write("positions.jsonl", "[1, 2, 3]\n");
    }

    [[nodiscard]] static bool reads_volume() {
        const std::string command = GetParam();
        return command != "bake" && command != "grid" && command != "tetrahedralize";
    }

    [[nodiscard]] static Arguments arguments(const std::string& output) {
        const std::string command = GetParam();
        if (command == "bake") return {"bake", kCourtyard, "-o", output, "-s", "1"};
        if (command == "grid") {
            return {"grid",  "empty.gltf", "-o",    output,  "--spacing", "1",
                    "--min", "0,0,0",      "--max", "1,1,1", "--sky",     "1"};
        }
        if (command == "lppv") return {"lppv", "v.probes", "-o", output, "--resolution", "2,2,2"};
        if (command == "query") return {"query", "v.probes", "positions.jsonl", "-o", output};
        if (command == "tetrahedralize") return {"tetrahedralize", "five.json", "-o", output};
        Arguments picture{command};
        if (command == "render") picture.push_back(kCourtyard);
        for (const char* word : {"v.probes", "--width", "4", "--height", "4", "-o"}) {
            picture.emplace_back(word);
        }
        picture.push_back(output);
        return picture;
    }
};

INSTANTIATE_TEST_SUITE_P(Main, EveryWriter,
                         testing::Values("bake", "grid", "lppv", "meshball", "query", "render",
                                         "tetrahedralize"),
                         [](const auto& instance) { return std::string(instance.param); });

TEST_P(EveryWriter, ReplacesAnOldFileAndLeavesNothingElse) {
    write("out", "old");
    const auto names_before = file_names();
    succeed(arguments("out"));
    EXPECT_NE(read("out"), "old");
    EXPECT_EQ(file_names(), names_before);
}

TEST_P(EveryWriter, NamesAnOutputThatCannotBeWritten) {
    std::filesystem::create_directory(path("folder"));
    write("file", "");
    for (const std::string output :
         {"none/out", "folder", "file/out", "/proc/tetralight", "/dev/full"}) {
        const int exit_code = output == "/dev/full" ? 75 : 1;  // a full disk: try again
        EXPECT_TRUE(contains(fail(arguments(output), "", exit_code), output + ": cannot write"));
    }
}

TEST_P(EveryWriter, RefusesThingsThatAreNoFilesAtOnce) {
    ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
    EXPECT_TRUE(contains(fail(arguments("pipe")), "pipe: cannot write (is a pipe"));
    for (const std::string name : {"/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"}) {
        EXPECT_TRUE(contains(fail(arguments(name)), name + ": cannot write (names an open file"));
    }
}

TEST_P(EveryWriter, FollowsSymbolicLinksThatEndSomewhere) {
    std::filesystem::create_symlink("target", path("link"));
    std::filesystem::create_symlink("loop", path("loop"));
    std::filesystem::create_symlink("none/target", path("lost"));
    succeed(arguments("link"));
    EXPECT_TRUE(std::filesystem::is_symlink(path("link")));
    EXPECT_EQ(read("target"), read("link"));
    EXPECT_FALSE(read("target").empty());
    EXPECT_TRUE(
        contains(fail(arguments("loop")), "loop: cannot write (its symbolic links form a cycle"));
    EXPECT_TRUE(contains(fail(arguments("lost")), "lost: cannot write (there is no folder none)"));
}

TEST_P(EveryWriter, RefusesAnExtensionOfAnotherFormat) {
    const auto names_before = file_names();
    for (const std::string name : {"out.jpg", "out.obj"}) {
        const std::string message = misuse(arguments(name));
        EXPECT_TRUE(contains(message, "--output: cannot write \"." + name.substr(4))) << message;
    }
    EXPECT_EQ(file_names(), names_before);
}

TEST_P(EveryWriter, RefusesAnEmptyOutput) {
    EXPECT_TRUE(contains(misuse(arguments("")), "--output: the path is empty"));
}

TEST_P(EveryWriter, WritesToADevice) {
    succeed(arguments("/dev/null"));
}

TEST_P(EveryWriter, KeepsStdoutForTheOutputThatGoesThere) {
    succeed(arguments("out"));
    EXPECT_EQ(succeed(arguments("-")).out, read("out"));
}

TEST_P(EveryWriter, SaysNothingWhenQuiet) {
    Arguments quiet = arguments("out");
    quiet.emplace_back("--quiet");
    const CommandResult result = succeed(quiet);
    EXPECT_EQ(result.out + result.err, "");
}

TEST_P(EveryWriter, ReportsItsOutputAsJson) {
    EXPECT_EQ(run_json(arguments("out")).value("output", ""), "out");
}

TEST_P(EveryWriter, TakesAPathThatIsNotUtf8) {
    EXPECT_EQ(run_json(arguments("\xff")).value("output", ""), "\xef\xbf\xbd");
}

}  // namespace
}  // namespace tetralight::test
