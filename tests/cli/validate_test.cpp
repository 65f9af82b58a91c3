// SPDX-License-Identifier: Apache-2.0
#include "probes/probe_file.h"
#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

class Validate : public CommandFixture {};

TEST_F(Validate, FindsABakedVolumeSound) {
    bake_courtyard("v.probes");
    EXPECT_TRUE(contains(succeed({"validate", "v.probes"}).out, "v.probes: valid, 255 probes"));
}

TEST_F(Validate, SaysSoAsJson) {
    bake_courtyard("v.probes");
    const Json json = run_json({"validate", "v.probes"});
    EXPECT_EQ(json["is_valid"], true);
    EXPECT_EQ(json["problems"], Json::array());
    EXPECT_NEAR(json["cell_measure"].get<double>(), json["hull_measure"].get<double>(), 1e-6);
}

TEST_F(Validate, NamesTheSectionOfAFlippedByte) {
    bake_courtyard("v.probes");
    const auto file = open_probe_file(path("v.probes"));
    ASSERT_TRUE(file);
    const std::string sound = read("v.probes");
    for (const ProbeFile::Section& section : file->sections()) {
        std::string damaged = sound;
        damaged[section.offset + section.size / 2] ^= 0x10;
        write("damaged.probes", damaged);
        const std::string message = fail({"validate", "damaged.probes"});
        EXPECT_TRUE(contains(message, "damaged.probes: section \"" + section.name)) << message;
    }
}

TEST_F(Validate, NamesAGeometryProblem) {
    bake_courtyard("v.probes");
    const auto file = open_probe_file(path("v.probes"));
    ASSERT_TRUE(file);
    ProbeVolumeView bent = file->view();
    std::vector<glm::dvec3> exact(bent.exact_positions.begin(), bent.exact_positions.end());
    std::swap(exact[0], exact[1]);
    bent.exact_positions = exact;
    ASSERT_TRUE(write_probe_file(path("bent.probes"), bent));
    const CommandResult result = run({"validate", "bent.probes", "--json"});
    EXPECT_EQ(result.exit_code, 1);
    const Json json = Json::parse(result.out, nullptr, false);
    EXPECT_EQ(json["is_valid"], false);
    EXPECT_GE(json["problems"].size(), 1u);
    EXPECT_EQ(result.err.find("tetralight: bent.probes: "), 0u) << result.err;
}

TEST_F(Validate, SaysAsJsonThatAFileIsDamaged) {
    write("damaged.probes", "TETRAPV");
    const CommandResult result = run({"validate", "damaged.probes", "--json"});
    EXPECT_EQ(result.exit_code, 1);
    const Json json = Json::parse(result.out, nullptr, false);
    EXPECT_EQ(json["is_valid"], false);
    EXPECT_EQ(json["problems"].size(), 1u);
}

TEST_F(Validate, RefusesBadVolumes) {
    bake_courtyard("sound.probes");
    refuse_each(bad_volumes(read("sound.probes")), "", [](const std::string& name) {
        return Arguments{"validate", name};
    });
}

TEST_F(Validate, NamesAVolumeThatIsNotThere) {
    EXPECT_TRUE(contains(fail({"validate", "none.probes"}), "none.probes: cannot open"));
}

}  // namespace
}  // namespace tetralight::test
