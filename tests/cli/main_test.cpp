// SPDX-License-Identifier: Apache-2.0
// What all subcommands have in common.
#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

class Main : public CommandFixture {};

TEST_F(Main, SaysItsVersion) {
    EXPECT_EQ(succeed({"--version"}).out.find("tetralight "), 0u);
}

TEST_F(Main, HelpListsTheSubcommands) {
    const std::string out = succeed({"--help"}).out;
    for (const char* name : {"bake", "grid", "info", "merge", "meshball", "prune", "query",
                             "render", "tetrahedralize", "validate", "world"}) {
        EXPECT_TRUE(contains(out, std::string("\n  ") + name)) << name;
    }
}

TEST_F(Main, WantsASubcommand) {
    EXPECT_TRUE(contains(misuse({}), "a command is required"));
}

TEST_F(Main, OnlyTheFirstWordSelectsTheCommand) {
    EXPECT_TRUE(contains(fail({"validate", "info"}), "info: cannot open"));
    EXPECT_TRUE(contains(fail({"validate", "man"}), "man: cannot open"));
    EXPECT_TRUE(contains(fail({"validate", "--", "--volume"}), "--volume: cannot open"));
    EXPECT_TRUE(contains(fail({"--quiet", "info", "bake"}), "bake: cannot open"));
    const CommandResult job = run({"--job", "-", "bake"});
    EXPECT_EQ(job.exit_code, 2);
    EXPECT_TRUE(contains(job.err, "unexpected argument \"bake\"")) << job.err;
    EXPECT_TRUE(contains(misuse({"man", "bake", "extra"}), "unexpected argument \"extra\""));
}

TEST_F(Main, ManPagesAreThoseOfTheirCommands) {
    EXPECT_TRUE(contains(succeed({"man"}).out, ".TH TETRALIGHT 1"));
    const std::string page = succeed({"man", "bake"}).out;
    EXPECT_TRUE(contains(page, ".TH TETRALIGHT\\-BAKE 1")) << page;
    EXPECT_TRUE(contains(page, "target\\-error")) << page;
    EXPECT_TRUE(contains(misuse({"man", "nope"}), "there is no command \"nope\""));
}

TEST_F(Main, HelpWinsOverOtherMistakes) {
    const std::string help = succeed({"bake", "--help"}).out;
    EXPECT_EQ(succeed({"help", "bake"}).out, help);
    EXPECT_EQ(succeed({"bake", "s.glb", "-h", "-o"}).out, help);
    EXPECT_EQ(succeed({"man", "--help"}).out, succeed({"--help"}).out);
}

TEST_F(Main, SaysHowLongOptionsAndVectorsAreWritten) {
    EXPECT_TRUE(contains(misuse({"bake", "s.glb", "-samples", "3"}), "did you mean --samples?"));
    EXPECT_TRUE(contains(misuse({"bake", "s.glb", "--sun-direction", "0", "-1", "0"}),
                         "several numbers are written 0,-1,0"));
}

TEST_F(Main, NamesAnUnknownSubcommand) {
    EXPECT_TRUE(contains(misuse({"frobnicate", "x"}), "\"frobnicate\""));
}

class EverySubcommand : public CommandFixture, public testing::WithParamInterface<const char*> {};

INSTANTIATE_TEST_SUITE_P(Main, EverySubcommand,
                         testing::Values("bake", "grid", "info", "merge", "meshball", "prune",
                                         "query", "render", "tetrahedralize", "validate", "world"),
                         [](const auto& instance) { return std::string(instance.param); });

TEST_P(EverySubcommand, HelpHasAnExample) {
    const std::string out = succeed({GetParam(), "--help"}).out;
    const size_t example = out.find("Example:\n  ");
    ASSERT_NE(example, std::string::npos) << out;
    EXPECT_TRUE(contains(out.substr(example), std::string("tetralight ") + GetParam()));
}

TEST_P(EverySubcommand, HelpNamesTheCommonOptions) {
    const std::string out = succeed({GetParam(), "--help"}).out;
    for (const char* option : {"--json", "--quiet", "--threads"}) {
        EXPECT_TRUE(contains(out, option)) << option;
    }
}

TEST_P(EverySubcommand, WantsItsArgumentsAndNamesItself) {
    const std::string message = misuse({GetParam()});
    EXPECT_TRUE(contains(message, "required"));
    EXPECT_TRUE(contains(message, std::string("tetralight ") + GetParam() + " --help"));
}

TEST_P(EverySubcommand, RefusesAnUnknownOption) {
    EXPECT_TRUE(
        contains(misuse({GetParam(), "a", "b", "-o", "c", "--spacing", "1", "--frobnicate"}),
                 "--frobnicate"));
}

TEST_P(EverySubcommand, RefusesAnEmptyPath) {
    const std::string command = GetParam();
    Arguments arguments{command, ""};
    if (command == "render") arguments.emplace_back("b");
    if (command == "grid") arguments.insert(arguments.end(), {"--spacing", "1"});
    if (command == "prune") {
        arguments.insert(arguments.end(), {"--limit", "1"});
    } else if (command != "info" && command != "query" && command != "validate") {
        arguments.insert(arguments.end(), {"-o", "c"});
    }
    const std::string message = misuse(arguments);
    EXPECT_TRUE(contains(message, "the path is empty")) << message;
}

struct BadOption {
    const char* command;
    const char* option;
    const char* value;
};

std::string arguments_name(const BadOption& bad) {
    return std::string(bad.command) + " " + bad.option + " " + bad.value;
}

/// The smallest arguments that a subcommand accepts; the files need not be there.
Arguments least_arguments(const std::string& command) {
    if (command == "grid") return {"grid", "s.glb", "-o", "g.json", "--spacing", "2"};
    if (command == "render") return {"render", "s.glb", "v.probes", "-o", "r.png"};
    if (command == "meshball") return {"meshball", "v.probes", "-o", "m.png"};
    if (command == "query") return {"query", "v.probes", "-o", "a.csv"};
    if (command == "prune") return {"prune", "store", "--limit", "1"};
    return {command, "s.glb", "-o", "v.probes"};
}

/// Values that are wrong whatever the files hold.
constexpr BadOption kBadOptions[] = {{"bake", "--samples", "0"},
                                     {"bake", "--samples", "many"},
                                     {"bake", "--samples", "1.5"},
                                     {"bake", "--bounces", "-1"},
                                     {"bake", "--seed", "-1"},
                                     {"bake", "--seed", "x"},
                                     {"bake", "--seed", "18446744073709551616"},
                                     {"bake", "--weld", "nan"},
                                     {"bake", "--weld", "0.5"},
                                     {"bake", "--threads", "-1"},
                                     {"bake", "--sky", "-1,0,0"},
                                     {"bake", "--sky", "nan,0,0"},
                                     {"bake", "--sky", "-0.5"},
                                     {"bake", "--sky", "1,2"},
                                     {"bake", "--sky", "1,2,3,4"},
                                     {"bake", "--sky-intensity", "-1"},
                                     {"bake", "--sky-intensity", "nan"},
                                     {"bake", "--sky-rotation", "inf"},
                                     {"bake", "--sun-mode", "dim"},
                                     {"bake", "--sun-mode", "baked"},
                                     {"bake", "--sun-angle", "181"},
                                     {"bake", "--albedo-boost", "0.5"},
                                     {"bake", "--albedo-boost", "nan"},
                                     {"bake", "--max-albedo", "1.5"},
                                     {"bake", "--sun-direction", "0,-1,0"},
                                     {"bake", "--only-given-groups", ""},
                                     {"grid", "--min", "0,0,0"},
                                     {"grid", "--max", "1,2"},
                                     {"grid", "--max-probes", "few"},
                                     {"grid", "--name", ""},
                                     {"grid", "--name", "two\nlines"},
                                     {"query", "--from", "csv"},
                                     {"query", "--to", "json"},
                                     {"query", "--to", "raw"},
                                     {"query", "--outside", "nowhere"},
                                     {"query", "--fade", "0"},
                                     {"query", "--fade", "nan"},
                                     {"query", "--fade", "3"},
                                     {"query", "--precision", "double"},
                                     {"tetrahedralize", "--weld", "-1"},
                                     {"render", "--width", "0"},
                                     {"render", "--height", "16385"},
                                     {"render", "--antialias", "0"},
                                     {"render", "--exposure", "nan"},
                                     {"render", "--exposure", "-1"},
                                     {"render", "--fov", "nan"},
                                     {"render", "--fov", "60"},
                                     {"render", "--eye", "0,0,0"},
                                     {"render", "--target", "a,b,c"},
                                     {"meshball", "--count", "-1"},
                                     {"meshball", "--radius", "0"},
                                     {"meshball", "--radius", "nan"},
                                     {"meshball", "--center", "nan,0,0"},
                                     {"meshball", "--center", "0,0"},
                                     {"meshball", "--fov", "60"},
                                     {"meshball", "--seed", "-3"},
                                     {"meshball", "--seed", "99999999999999999999"}};

TEST_F(Main, RefusesOptionsThatAreWrongByThemselves) {
    for (const BadOption& bad : kBadOptions) {
        SCOPED_TRACE(arguments_name(bad));
        Arguments arguments = least_arguments(bad.command);
        arguments.emplace_back(bad.option);
        if (bad.value != std::string("") || bad.option == std::string("--name")) {
            arguments.emplace_back(bad.value);
        }
        EXPECT_TRUE(contains(misuse(arguments), bad.option));
    }
}

TEST_P(EverySubcommand, SaysInPlainWordsThatAnOptionIsWrong) {
    Arguments arguments = least_arguments(GetParam());
    if (GetParam() == std::string("info") || GetParam() == std::string("validate")) {
        arguments.resize(2);  // they have no -o
    }
    const auto with = [&](const Arguments& more) {
        Arguments all = arguments;
        all.insert(all.end(), more.begin(), more.end());
        return misuse(all);
    };
    for (const char* count : {"-1", "many", "1.5", "99999999999"}) {
        EXPECT_TRUE(contains(with({"-j", count}),
                             std::string("--threads: \"") + count +
                                 "\" is not a whole number from 0 to 65535 (see tetralight "));
    }
    EXPECT_TRUE(contains(with({"-j", "1", "-j", "2"}),
                         ": --threads is given more than once (see tetralight "));
    EXPECT_TRUE(contains(with({"-j"}), ": --threads is given without a value (see tetralight "));
}

}  // namespace
}  // namespace tetralight::test
