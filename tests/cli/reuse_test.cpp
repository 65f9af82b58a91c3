// SPDX-License-Identifier: Apache-2.0
// `tetralight bake --reuse`: only what changed is baked.
#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

class Reuse : public CommandFixture {
  protected:
    Reuse() {
        succeed({"grid", kCourtyard, "-o", "old.json", "--spacing", "2"});
        succeed(bake("old.json", "old.probes"));
    }

    [[nodiscard]] static Arguments bake(const std::string& groups, const std::string& output,
                                        const Arguments& more = {}) {
        Arguments arguments{"bake",
                            kCourtyard,
                            "-g",
                            groups,
                            "--only-given-groups",
                            "-o",
                            output,
                            "-s",
                            "32",
                            "--mixed-lighting",
                            "shadowmask",
                            "--layers",
                            "sun,sky,transfer",
                            "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }

    /// Moves two probes, adds one and removes one. Returns how many stayed where they were.
    size_t edit_groups() const {
        Json groups = Json::parse(read("old.json"));
        Json& positions = groups["groups"][0]["positions"];
        for (const size_t probe : {3u, 40u}) {
            positions[probe][1] = positions[probe][1].get<double>() + 0.25;
        }
        positions.erase(10);
        const size_t stayed = positions.size() - 2;
        positions.push_back({0.3, 1.9, 0.4});
        write("new.json", groups.dump());
        return stayed;
    }
};

TEST_F(Reuse, GivesTheBytesOfAFullBakeWithFewRays) {
    const size_t stayed = edit_groups();
    const Json full = Json::parse(succeed(bake("new.json", "full.probes")).out);
    const Json rest =
        Json::parse(succeed(bake("new.json", "rest.probes", {"--reuse", "old.probes"})).out);
    EXPECT_TRUE(read("rest.probes") == read("full.probes"));
    // A few look from elsewhere, because a neighbor went away.
    EXPECT_LE(rest["reused"], stayed);
    EXPECT_GE(rest["reused"], stayed - 20);
    EXPECT_EQ(full["reused"], 0);
    EXPECT_LT(rest["rays"].get<double>(), 0.2 * full["rays"].get<double>());
    EXPECT_EQ(rest["standard_error"], full["standard_error"]);
}

TEST_F(Reuse, MayTakeThePlaceOfTheOldVolume) {
    edit_groups();
    succeed(bake("new.json", "full.probes"));
    succeed(bake("new.json", "old.probes", {"--reuse", "old.probes", "--chunks", "chunks"}));
    EXPECT_TRUE(read("old.probes") == read("full.probes"));
}

TEST_F(Reuse, SaysWhyItBakesAllWhereSomethingElseIsDifferent) {
    succeed({"tetrahedralize", "old.json", "-o", "dark.probes"});
    const std::vector<std::tuple<std::string, Arguments, std::string>> cases{
        {"old.probes", {"--seed", "3"}, "its setting seed is 0, that of this bake is 3"},
        {"old.probes", {"--sky", "1"}, "its scene, sky or sun is different"},
        {"dark.probes", {}, "it has no light"}};
    for (const auto& [old, change, reason] : cases) {
        succeed(bake("old.json", "full.probes", change));
        Arguments arguments = bake("old.json", "new.probes", change);
        arguments.insert(arguments.end(), {"--reuse", old});
        const CommandResult result = succeed(arguments);
        EXPECT_TRUE(contains(result.err, old + ": nothing is reused: " + reason)) << result.err;
        EXPECT_EQ(Json::parse(result.out)["reused"], 0);
        EXPECT_TRUE(read("new.probes") == read("full.probes")) << reason;
    }
}

TEST_F(Reuse, RefusesAFileThatIsNoVolume) {
    const auto arguments = [](const std::string& old) {
        Arguments plain = bake("old.json", "new.probes", {"--reuse", old});
        std::erase(plain, "--json");
        return plain;
    };
    EXPECT_TRUE(contains(fail(arguments("none.probes")), "none.probes: "));
    refuse_each(bad_volumes(read("old.probes")), "", arguments);
}

TEST_F(Reuse, ComposesWithRangesAndStores) {
    edit_groups();
    succeed(bake("new.json", "full.probes"));
    const Arguments reuse{"--reuse", "old.probes"};
    const auto with = [&](const Arguments& more) {
        Arguments arguments = reuse;
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    };
    succeed(bake("new.json", "a.part", with({"--probes", "0..9", "--resume"})));
    succeed(bake("new.json", "b.part", with({"--probes", "9..", "--chunks", "chunks"})));
    succeed({"merge", "a.part", "b.part", "-o", "merged.probes"});
    EXPECT_TRUE(read("merged.probes") == read("full.probes"));
    succeed(bake("new.json", "resumed.probes", with({"--resume", "--store", "chunks"})));
    EXPECT_TRUE(read("resumed.probes") == read("full.probes"));
}

}  // namespace
}  // namespace tetralight::test
