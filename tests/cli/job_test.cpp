// SPDX-License-Identifier: Apache-2.0
// Commands as JSON jobs (docs/command.md).
#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

class Job : public CommandFixture {
  protected:
    [[nodiscard]] CommandResult run_job(const Json& job) const {
        write("job.json", job.dump());
        return run({"--job", "job.json"});
    }

    [[nodiscard]] Json refusal(const Json& job) const {
        const CommandResult result = run_job(job);
        EXPECT_EQ(result.exit_code, 2) << result.err;
        return Json::parse(result.out)["error"];
    }
};

TEST_F(Job, GivesTheBytesOfTheCommand) {
    const CommandResult result = run_job(
        {{"command", "bake"}, {"scene", kCourtyard}, {"output", "a.probes"}, {"samples", 16}});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(Json::parse(result.out)["output"], "a.probes");
    succeed({"bake", kCourtyard, "-o", "b.probes", "-s", "16"});
    EXPECT_TRUE(read("a.probes") == read("b.probes"));
}

TEST_F(Job, IsReadFromStdin) {
    const CommandResult result =
        run({"--job", "-"}, R"({"command": "info", "volume": "nothing.probes"})");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_TRUE(Json::parse(result.out)["error"].contains("code"));
}

TEST_F(Job, WarningsAreAMemberOfTheResult) {
    write("five.json", kFiveProbes);
    succeed({"tetrahedralize", "five.json", "-o", "five.probes"});
    write("positions.txt", "0 0 0\n");
    const CommandResult result = run_job({{"command", "query"},
                                          {"volume", "five.probes"},
                                          {"positions", "positions.txt"},
                                          {"output", "light.csv"}});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_EQ(Json::parse(result.out)["warnings"].size(), 1u) << result.out;
}

TEST_F(Job, NamesTheMemberOfAnError) {
    EXPECT_EQ(refusal({{"command", "bakery"}})["field"], "command");
    EXPECT_EQ(refusal(Json::array())["code"], "invalid_argument");
    EXPECT_EQ(refusal({{"command", "bake"}, {"scene", 3}})["field"], "scene");
    const Json error = refusal({{"command", "bake"}, {"scene", "s.glb"}, {"bounces", -1}});
    EXPECT_EQ(error["field"], "bounces");
    EXPECT_EQ(error["value"], "-1");
}

TEST_F(Job, SaysWhereItsTextIsNoJson) {
    const auto message = [&](const std::string& text) {
        const CommandResult result = run({"--job", "-"}, text);
        EXPECT_EQ(result.exit_code, 2) << result.err;
        return Json::parse(result.out)["error"]["message"].get<std::string>();
    };
    EXPECT_TRUE(contains(message(R"({"command": "bake",})"), "stdin: is not a JSON object"));
    EXPECT_TRUE(contains(message(R"({"command": "bake",})"), "line 1, column 20"));
    const std::string deep = std::string(100'000, '[') + std::string(100'000, ']');
    EXPECT_EQ(message(R"({"command": "bake", "a": )" + deep + "}"),
              "stdin: JSON is nested deeper than 64");
}

TEST_F(Job, NamesAKeyThatIsGivenTwice) {
    const CommandResult result = run({"--job", "-"}, R"({"command": "info", "command": "bake"})");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(Json::parse(result.out)["error"]["field"], "command");
}

TEST_F(Job, WholeNumbersMayHaveADecimalPoint) {
    write("five.json", kFiveProbes);
    const Json job{{"command", "bake"},
                   {"scene", kCourtyard},
                   {"output", "v.probes"},
                   {"groups", {"five.json"}},
                   {"samples", 16.0}};
    EXPECT_EQ(run_job(job).exit_code, 0);
    EXPECT_EQ(refusal({{"command", "bake"}, {"scene", "s.glb"}, {"samples", 16.5}})["field"],
              "samples");
}

TEST_F(Job, PositionsCannotComeFromTheStdinOfTheJob) {
    const CommandResult result = run({"--job", "-"}, R"({"command": "query", "volume": "v"})");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(Json::parse(result.out)["error"]["field"], "positions");
}

}  // namespace
}  // namespace tetralight::test
