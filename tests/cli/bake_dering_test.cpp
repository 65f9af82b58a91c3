// SPDX-License-Identifier: Apache-2.0
#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

class BakeDering : public CommandFixture {
  protected:
    BakeDering() {
        write("empty.gltf", kEmptyScene);
        write("five.json", kFiveProbes);
    }

    /// Coefficient 1 over coefficient 0 of a probe that a sun from above lights. Without a window
    /// it is (2π/3 · 0.4886²) / (π · 0.2821 · 0.2821) · 0.2821 / 0.4886 = 2/√3.
    [[nodiscard]] double slope(const Arguments& more) const {
        Arguments arguments{"bake",
                            "empty.gltf",
                            "-g",
                            "five.json",
                            "-o",
                            "v.probes",
                            "-s",
                            "16",
                            "--sun-direction",
                            "0,-1,0",
                            "--sun-irradiance",
                            "1,1,1",
                            "--sun-mode",
                            "baked"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        succeed(arguments);
        const Json answer = Json::parse(succeed({"query", "v.probes", "--json"}, "1 1 1").out);
        const Json& sh = answer["irradiance_sh"];
        return sh[1][0].get<double>() / sh[0][0].get<double>();
    }
};

constexpr double kRaw = 1.1547005;  // 2/√3

TEST_F(BakeDering, IsOffUnlessAskedFor) {
    EXPECT_NEAR(slope({}), kRaw, 1e-3);
}

TEST_F(BakeDering, ScalesTheBandsOfAllGroups) {
    // mean / (mean − least) = (1/4) / (1/4 + 0.0395833), see ShMinimum.
    EXPECT_NEAR(slope({"--dering"}), kRaw * 0.25 / 0.2895833, 1e-3);
    EXPECT_NEAR(slope({"--dering", "--dering-window", "hann"}), kRaw * 0.75, 1e-3);
    EXPECT_NEAR(slope({"--dering", "--dering-window", "lanczos"}), kRaw * 0.8269933, 1e-3);
}

TEST_F(BakeDering, IsSaidByInfo) {
    (void)slope({"--dering"});
    EXPECT_EQ(run_json({"info", "v.probes"})["made_with"]["dering"], "mildest");
}

TEST_F(BakeDering, NamesAWindowThatIsNotKnown) {
    const std::string message =
        misuse({"bake", "empty.gltf", "-o", "v.probes", "--dering-window", "box"});
    EXPECT_TRUE(contains(message, "--dering-window")) << message;
}

}  // namespace
}  // namespace tetralight::test
