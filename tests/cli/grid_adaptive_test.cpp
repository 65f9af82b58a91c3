// SPDX-License-Identifier: Apache-2.0
// `grid --mode adaptive`, its pictures, and what adjustment volumes change.
#include <csignal>
#include <set>
#include <thread>

#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

class GridAdaptive : public CommandFixture {
  protected:
    [[nodiscard]] size_t count_in(const std::string& file) const {
        size_t count = 0;
        const Json json = Json::parse(read(file));
        for (const Json& group : json["groups"]) count += group["positions"].size();
        return count;
    }

    /// A long run to g.json that gets Ctrl-C after two seconds.
    [[nodiscard]] CommandResult interrupted() const {
        RunningCommand grid(folder(),
                            {"grid", kCourtyard, "-o", "g.json", "--mode", "adaptive",
                             "--target-error", "0.01%", "--max-probes", "50000"},
                            "");
        while (!grid.handles(SIGINT)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        std::this_thread::sleep_for(std::chrono::seconds(2));
        grid.send(SIGINT);
        return grid.wait();
    }
};

TEST_F(GridAdaptive, ReportsTheErrorThatItReached) {
    const Json json = run_json({"grid", kCourtyard, "-o", "g.json", "--mode", "adaptive",
                                "--max-probes", "120", "--target-error", "1%"});
    EXPECT_LE(json["probes"], 120);
    EXPECT_GE(json["probes"], 118);
    EXPECT_GE(json["coverage"]["covered"], 0.97);
    EXPECT_EQ(json["adaptive"]["end"], "most probes");
    EXPECT_GT(json["adaptive"]["error"], 0.01);
    EXPECT_EQ(count_in("g.json"), json["probes"]);
}

TEST_F(GridAdaptive, GivesTheSameBytesForAnyNumberOfThreads) {
    for (const char* threads : {"1", "2"}) {
        succeed({"grid", kCourtyard, "-o", std::string(threads) + ".json", "--mode", "adaptive",
                 "--max-probes", "60", "-j", threads});
    }
    EXPECT_TRUE(read("1.json") == read("2.json"));
}

TEST_F(GridAdaptive, CtrlCLeavesTheLastWholeResult) {
    const CommandResult result = interrupted();
    EXPECT_EQ(result.exit_code, 130);
    if (contains(result.err, "g.json holds the last whole result")) {
        EXPECT_GT(count_in("g.json"), 4u);
    } else {
        EXPECT_TRUE(contains(result.err, "interrupted")) << result.err;  // a slow machine
        EXPECT_TRUE(file_names().empty());
    }
}

TEST_F(GridAdaptive, CtrlCPutsTheLastWholeResultBesideAnOlderFile) {
    write("g.json", "old");
    const CommandResult result = interrupted();
    EXPECT_EQ(result.exit_code, 130);
    EXPECT_TRUE(contains(result.err, "interrupted; g.json is as it was")) << result.err;
    EXPECT_EQ(read("g.json"), "old");
    if (contains(result.err, "g.partial.json holds the last whole result")) {
        EXPECT_GT(count_in("g.partial.json"), 4u);
    } else {
        EXPECT_EQ(file_names().size(), 1u);  // a slow machine
    }
}

TEST_F(GridAdaptive, SaysThatItBeganWithAWiderSpacing) {
    const CommandResult result =
        succeed({"grid", kCourtyard, "-o", "g.json", "--mode", "adaptive", "--spacing", "0.5",
                 "--max-probes", "40", "--target-error", "50%"});
    EXPECT_TRUE(contains(result.err, "--spacing 0.5,0.5,0.5 asks for more than half"))
        << result.err;
}

TEST_F(GridAdaptive, OptionsOfItsOwnAreForItAlone) {
    for (const char* option : {"--target-error", "--time-budget", "--bounces", "--seed"}) {
        EXPECT_TRUE(
            contains(misuse({"grid", kCourtyard, "-o", "g.json", "--spacing", "2", option, "1"}),
                     "is for --mode adaptive"))
            << option;
    }
}

TEST_F(GridAdaptive, ErrorsAreRelativeToWhatIsAsked) {
    const Arguments command{"grid",     kCourtyard,     "-o", "g.json",         "--mode",
                            "adaptive", "--max-probes", "60", "--target-error", "1%"};
    std::set<double> errors;
    for (const char* kind : {"absolute", "relative", "mixed"}) {
        Arguments arguments = command;
        arguments.insert(arguments.end(), {"--error", kind});
        errors.insert(run_json(arguments)["adaptive"]["error"].get<double>());
    }
    EXPECT_EQ(errors.size(), 3u);
    EXPECT_TRUE(contains(
        misuse({"grid", kCourtyard, "-o", "g.json", "--spacing", "2", "--error", "relative"}),
        "is for --mode adaptive"));
}

TEST_F(GridAdaptive, PreviewIsAPicture) {
    succeed({"grid", kCourtyard, "-o", "g.json", "--spacing", "4", "--preview", "g.png", "--width",
             "160", "--height", "120"});
    EXPECT_EQ(read("g.png").substr(1, 3), "PNG");
    succeed({"grid", kCourtyard, "-o", "g.json", "--spacing", "4", "--preview", "g.png", "--width",
             "64", "--height", "48", "--eye", "0,9,9", "--target", "0,0,0"});
    EXPECT_EQ(read("g.png").substr(16, 8), std::string("\0\0\0\x40\0\0\0\x30", 8));
    EXPECT_TRUE(
        contains(misuse({"grid", kCourtyard, "-o", "g.json", "--spacing", "4", "--width", "64"}),
                 "--preview"));
    EXPECT_TRUE(contains(misuse({"grid", kCourtyard, "-o", "g.json", "--spacing", "4", "--preview",
                                 "g.png", "--eye", "1,2,3", "--target", "1,2,3"}),
                         "--target: is the same point as --eye"));
    const std::string message =
        fail({"grid", kCourtyard, "-o", "g.json", "--spacing", "4", "--preview", "no/g.png"});
    EXPECT_TRUE(contains(message, "no/g.png")) << message;
}

TEST_F(GridAdaptive, AdjustmentsReachTheGridAndTheBake) {
    write("a.json", R"({"adjustments": [{"name": "all", "shape": "box", "size": [900, 900, 900],
                                         "intensity": 0, "spacing": 5}]})");
    const Json plain = run_json({"grid", kCourtyard, "-o", "plain.json", "--spacing", "4"});
    const Json wide = run_json(
        {"grid", kCourtyard, "-o", "wide.json", "--spacing", "4", "--adjustments", "a.json"});
    EXPECT_LT(wide["candidates"], plain["candidates"]);
    succeed({"bake", kCourtyard, "-g", "wide.json", "--only-given-groups", "-o", "v.probes", "-s",
             "16", "--adjustments", "a.json"});
    std::string table = succeed({"query", "v.probes", "--to", "csv"}, "0 1.5 0\n").out;
    std::erase(table, '-');  // of -0
    size_t place = table.find('\n');
    for (int comma = 0; comma < 4; ++comma) place = table.find(',', place + 1);  // x, y, z, cell
    EXPECT_TRUE(table.substr(place).starts_with(",0,0,0,0,0,0,0,0,0,")) << table;
}

TEST_F(GridAdaptive, SaysWhichVolumesDoNothing) {
    const Arguments command{"grid", kCourtyard,      "-o",    "g.json", "--spacing",
                            "4",    "--adjustments", "a.json"};
    write("a.json", R"({"adjustments": [{"name": "x", "shape": "sphere", "center": [0, 900, 0],
                                         "radius": 2, "spacing": 1}]})");
    EXPECT_TRUE(
        contains(succeed(command).err, "adjustment volume \"x\" lies outside of the box to fill"));
    write("a.json", R"({"adjustments": [{"name": "x", "shape": "box", "size": [1, -2, 1],
                                         "forbid": true}]})");
    EXPECT_TRUE(contains(fail(command),
                         "a.json: adjustment volume \"x\": size -2 is not a positive length"));
}

TEST_F(GridAdaptive, BadAdjustmentsAreRefusedAndTheOldFileStays) {
    write("a.json", R"({"adjustments": [{"name": "x", "shape": "box", "spacing": -1}]})");
    const std::string message = fail_and_keep(
        "g.json",
        {"grid", kCourtyard, "-o", "g.json", "--spacing", "4", "--adjustments", "a.json"});
    EXPECT_TRUE(contains(message, "a.json: adjustment volume \"x\": spacing -1 is not a positive"))
        << message;
}

}  // namespace
}  // namespace tetralight::test
