// SPDX-License-Identifier: Apache-2.0
#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

class Merge : public CommandFixture {
  protected:
    void bake(const std::string& output, const Arguments& more) const {
        Arguments arguments{"bake", kCourtyard, "-o", output, "-s", "16", "-q"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        succeed(arguments);
    }
};

TEST_F(Merge, GivesTheBytesOfOneBake) {
    for (const Arguments& more : {Arguments{}, Arguments{"--target-error", "30%"}}) {
        const auto range = [&](const char* probes) {
            Arguments arguments = more;
            arguments.insert(arguments.end(), {"--probes", probes});
            return arguments;
        };
        bake("a.part", range("0..100"));
        bake("b.part", range("100..101"));
        bake("c.part", range("101.."));
        bake("whole.probes", more);
        succeed({"merge", "c.part", "a.part", "b.part", "-o", "merged.probes"});
        EXPECT_TRUE(read("merged.probes") == read("whole.probes"));
    }
}

TEST_F(Merge, JsonHasTheDocumentedFields) {
    bake("a.part", {"--probes", "0.."});
    const Json json = run_json({"merge", "a.part", "-o", "v.probes"});
    std::vector<std::string> keys;
    for (const auto& [key, value] : json.items()) keys.push_back(key);
    EXPECT_EQ(keys, (std::vector<std::string>{"dilated", "dimension", "groups", "hull_cells",
                                              "inner_cells", "output", "over_target", "parts",
                                              "probes", "rays", "samples_per_probe",
                                              "standard_error", "unseen", "walls", "welded"}));
}

TEST_F(Merge, PartsSayWhatTheyHold) {
    const Json json =
        run_json({"bake", kCourtyard, "-o", "a.part", "-s", "16", "--probes", "10..20"});
    EXPECT_EQ(json["range"], Json::array({10, 20}));
    EXPECT_EQ(json["probes"], 10);
    EXPECT_EQ(json["all_probes"], 255);
}

TEST_F(Merge, RefusesPartsThatDoNotCoverAllProbesOnce) {
    bake("a.part", {"--probes", "0..100"});
    bake("b.part", {"--probes", "99.."});
    EXPECT_TRUE(contains(fail_and_keep("v.probes", {"merge", "a.part", "-o", "v.probes"}),
                         "probes 100..255 of 255 are in no part"));
    EXPECT_TRUE(contains(fail_and_keep("v.probes", {"merge", "a.part", "b.part", "-o", "v.probes"}),
                         "b.part: probes 99..255 overlap probes 0..100 of a.part"));
}

TEST_F(Merge, RefusesPartsOfDifferentBakes) {
    bake("a.part", {"--probes", "0..100"});
    bake("b.part", {"--probes", "100..", "--seed", "1"});
    EXPECT_TRUE(contains(fail_and_keep("v.probes", {"merge", "a.part", "b.part", "-o", "v.probes"}),
                         "b.part: is of another bake than a.part"));
}

TEST_F(Merge, RefusesBadFilesAndKeepsTheOldVolume) {
    bake("sound.part", {"--probes", "0.."});
    refuse_each(bad_volumes(read("sound.part")), "old.probes", [](const std::string& name) {
        return Arguments{"merge", name, "-o", "old.probes"};
    });
    bake("whole.probes", {});
    EXPECT_TRUE(
        contains(fail({"merge", "whole.probes", "-o", "v.probes"}), "is not a part of a bake"));
}

TEST_F(Merge, RefusesRangesBeyondTheProbes) {
    EXPECT_TRUE(contains(fail({"bake", kCourtyard, "-o", "a.part", "--probes", "250..256"}),
                         "--probes: 250..256 is not within the 255 probes that are baked, 0..255"));
}

TEST_F(Merge, PartsAndVolumesAreNotMistakenForEachOther) {
    for (const Arguments& wrong :
         {Arguments{"-o", "v.part"}, Arguments{"-o", "v.probes", "--probes", "0..5"}}) {
        Arguments arguments{"bake", kCourtyard};
        arguments.insert(arguments.end(), wrong.begin(), wrong.end());
        EXPECT_TRUE(contains(misuse(arguments), "--output"));
    }
}

TEST_F(Merge, ReportsTheWallsOfTheBake) {
    bake("a.part", {"--probes", "0.."});
    const Json merged = run_json({"merge", "a.part", "-o", "v.probes"});
    Json baked = run_json({"bake", kCourtyard, "-o", "whole.probes", "-s", "16"});
    EXPECT_GT(baked["walls"]["rays"], 0);
    baked["walls"].erase("rays");  // parts do not keep their number
    EXPECT_EQ(merged["walls"], baked["walls"]);
    EXPECT_EQ(merged["unseen"], baked["unseen"]);
}

}  // namespace
}  // namespace tetralight::test
