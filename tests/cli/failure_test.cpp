// SPDX-License-Identifier: Apache-2.0
// What a failing command prints, and its exit code (docs/command.md).
#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

class Failure : public CommandFixture {
  protected:
    /// The "error" of the JSON object on stdout.
    [[nodiscard]] Json error_of(const Arguments& arguments, int exit_code) const {
        const CommandResult result = run(arguments);
        EXPECT_EQ(result.exit_code, exit_code) << result.err;
        const Json json = Json::parse(result.out, nullptr, false);
        EXPECT_TRUE(json.is_object()) << result.out;
        return json.value("error", Json::object());
    }
};

TEST_F(Failure, WrongUsageNamesTheSettingAndItsValueAsJson) {
    const Json error = error_of({"bake", "s.glb", "-o", "v.probes", "-b", "many", "--json"}, 2);
    EXPECT_EQ(error["code"], "invalid_argument");
    EXPECT_EQ(error["field"], "bounces");
    EXPECT_EQ(error["value"], "many");
    EXPECT_EQ(error["message"], "--bounces: \"many\" is not a whole number from 0 to 1000");
}

TEST_F(Failure, SettingsThatDoNotGoTogetherAreWrongUsageAsJson) {
    const Json error = error_of({"query", "v.probes", "--fade", "3", "--json"}, 2);
    EXPECT_EQ(error["code"], "invalid_argument");
    EXPECT_EQ(error["field"], "fade");
}

TEST_F(Failure, AnUnknownOptionIsWrongUsageAsJson) {
    const Json error = error_of({"info", "v.probes", "--frobnicate", "--json"}, 2);
    EXPECT_EQ(error["code"], "invalid_argument");
    EXPECT_EQ(error["value"], "--frobnicate");
}

TEST_F(Failure, BadDataAreOneObject) {
    write("v.probes", "no volume");
    const Json error = error_of({"info", "v.probes", "--json"}, 1);
    EXPECT_TRUE(error.contains("code"));
    EXPECT_TRUE(contains(error["message"], "v.probes"));
}

TEST_F(Failure, AFileThatIsNotThereIsTheValueOfItsSetting) {
    const Json error = error_of({"bake", "nosuch.glb", "-o", "v.probes", "--json"}, 1);
    EXPECT_EQ(error["code"], "not_found");
    EXPECT_EQ(error["field"], "scene");
    EXPECT_EQ(error["value"], "nosuch.glb");
    EXPECT_EQ(error_of({"validate", "nosuch.probes", "--json"}, 1)["field"], "volume");
    EXPECT_EQ(error_of({"bake", "s.glb", "-o", "no/v.probes", "--json"}, 1)["field"], "output");
}

TEST_F(Failure, ValidateReportsBesideTheError) {
    write("v.probes", "no volume");
    const CommandResult result = run({"validate", "v.probes", "--json"});
    EXPECT_EQ(result.exit_code, 1);
    const Json json = Json::parse(result.out);
    EXPECT_EQ(json["is_valid"], false);
    EXPECT_EQ(json["error"]["message"], json["problems"][0]);
}

TEST_F(Failure, AMisspelledOptionSuggestsTheNearOne) {
    const std::string message = misuse({"bake", "s.glb", "-o", "v.probes", "--sample", "16"});
    EXPECT_TRUE(contains(message, "there is no option --sample; did you mean --samples?"))
        << message;
}

TEST_F(Failure, UnknownOptionsAreNamedInTheOrderTyped) {
    const std::string message = misuse({"info", "v.probes", "--zeta", "--alpha=1", "--beta"});
    const size_t zeta = message.find("--zeta"), alpha = message.find("--alpha");
    EXPECT_LT(zeta, alpha);
    EXPECT_LT(alpha, message.find("--beta"));
}

TEST_F(Failure, AMisspelledSubcommandSuggestsTheNearOne) {
    EXPECT_TRUE(contains(misuse({"quary", "v.probes"}), "\"quary\"; did you mean query?"));
}

}  // namespace
}  // namespace tetralight::test
