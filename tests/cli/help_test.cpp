// SPDX-License-Identifier: Apache-2.0
// --help, manual pages and shell completion, which follow from the tables of settings.
#include <cstdlib>

#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

class Help : public CommandFixture {
  protected:
    /// What bash completes the words of a command line with, one a line.
    [[nodiscard]] std::string complete(const std::string& words, int index) const {
        const std::string script = "source <(" TETRALIGHT_COMMAND
                                   " completion bash); COMP_WORDS=(" +
                                   words + "); COMP_CWORD=" + std::to_string(index) +
                                   "; _tetralight; printf '%s\\n' \"${COMPREPLY[@]}\"";
        write("complete.sh", script);
        const std::string command = "bash " + path("complete.sh") + " > " + path("words.txt");
        EXPECT_EQ(std::system(command.c_str()), 0);
        return read("words.txt");
    }
};

TEST_F(Help, ShowsUnitsRangesAndDefaultsAsPeopleWriteThem) {
    const std::string out = succeed({"bake", "--help"}).out;
    EXPECT_TRUE(contains(out, "default: 0.75")) << out;
    EXPECT_TRUE(contains(out, "0 to 1000")) << out;
    EXPECT_FALSE(contains(out, "e+")) << out;
    EXPECT_TRUE(contains(out, "\nSamples:\n")) << out;
}

TEST_F(Help, BashCompletesCommandsOptionsAndChoices) {
    EXPECT_EQ(complete("tetralight me", 1), "merge\nmeshball\n");
    EXPECT_EQ(complete("tetralight bake --sam", 2), "--samples\n");
    EXPECT_EQ(complete("tetralight bake --dering-window l", 3), "lanczos\n");
    EXPECT_EQ(complete("tetralight completion z", 2), "zsh\n");
}

TEST_F(Help, ZshGetsAScriptOfItsOwn) {
    const std::string out = succeed({"completion", "zsh"}).out;
    EXPECT_EQ(out.find("#compdef tetralight\n"), 0u);
    EXPECT_TRUE(contains(out, "--samples=["));
    EXPECT_TRUE(contains(misuse({"completion", "fish"}), "\"fish\""));
}

TEST_F(Help, ManualPagesAreSound) {
    if (std::system("command -v man > /dev/null 2>&1") != 0) GTEST_SKIP() << "there is no man";
    for (const char* command : {"", "bake", "grid", "lppv", "query"}) {
        Arguments arguments{"man"};
        if (*command != '\0') arguments.emplace_back(command);
        write("page.1", succeed(arguments).out);
        const std::string check = "LC_ALL=C man --warnings -l " + path("page.1") +
                                  " > /dev/null 2> " + path("warnings.txt");
        EXPECT_EQ(std::system(check.c_str()), 0) << command;
        EXPECT_EQ(read("warnings.txt"), "") << command;
    }
}

}  // namespace
}  // namespace tetralight::test
