// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/error_text.h>
#include <tetralight/pipeline/partial_bake.h>

#include <cmath>
#include <fstream>
#include <functional>

#include "tests/pipeline/part_fixture.h"

namespace tetralight {
namespace {

class PartialBakes : public test::PartFixture {
  protected:
    /// Writes a part that was changed, and returns why it cannot be read.
    [[nodiscard]] std::string refusal(const std::function<void(PartialBake&)>& change) const {
        const PreparedBake prepared = prepare();
        PartialBake partial = bake(prepared, {3, 9});
        change(partial);
        EXPECT_TRUE(write_part(path("bad"), prepared, partial));
        const auto part = read_part(path("bad"));
        EXPECT_FALSE(part);
        return part ? "" : error_text(part.error());
    }
};

TEST_F(PartialBakes, ReadsBackWhatWasWritten) {
    const PreparedBake prepared = prepare();
    const PartialBake partial = bake(prepared, {3, 9});
    ASSERT_TRUE(write_part(path("part"), prepared, partial));
    const auto part = read_part(path("part"));
    ASSERT_TRUE(part) << error_text(part.error());
    EXPECT_EQ(part->partial, partial);
    EXPECT_EQ(part->prepared.key, prepared.key);
    EXPECT_EQ(part->prepared.volume, prepared.volume);
    EXPECT_EQ(part->prepared.merged.group_dering, prepared.merged.group_dering);
}

TEST_F(PartialBakes, RefusesReusedLightThatDoesNotFit) {
    const auto reuse = [](uint32_t probe, float light) {
        return [=](PartialBake& p) {
            p.accumulators[1] = {};
            p.reused.probes = {probe};
            p.reused.standard_error = {0.5f};
            p.reused.validity = {1.0f};
            p.reused.irradiance.resize(1);
            p.reused.irradiance[0].coefficients[8].z = light;
        };
    };
    const std::string where = path("bad") + ": section ";
    EXPECT_EQ(refusal(reuse(9, 1.0f)), where + "\"reused_probes\": element 0 is out of range");
    EXPECT_EQ(refusal(reuse(5, 1.0f)), where + "\"tallies\": element of probe 4 is out of range");
    EXPECT_EQ(refusal(reuse(4, NAN)), where + "\"reused_irradiance\": a number is not finite");
    EXPECT_EQ(refusal([&](auto& p) {
                  reuse(4, 1.0f)(p);
                  p.reused.validity.clear();
              }),
              where + "\"reused_validity\": 0 elements for 1 probes");
}

TEST_F(PartialBakes, IsAProbeFileWithoutLight) {
    const auto file = open_probe_file(bake_part("part", {3, 9}));
    ASSERT_TRUE(file) << error_text(file.error());
    EXPECT_EQ(file->view().probe_count(), kProbeCount);
    EXPECT_TRUE(file->view().irradiance.empty());
}

TEST_F(PartialBakes, RefusesTalliesThatNoRoundsLeave) {
    const std::string where =
        path("bad") + ": section \"tallies\": element of probe 4 is out of range";
    EXPECT_EQ(refusal([](auto& p) { p.accumulators[1].radiance_sum[8].z = NAN; }), where);
    EXPECT_EQ(refusal([](auto& p) { p.accumulators[1].variance_sum = -1.0; }), where);
    EXPECT_EQ(refusal([](auto& p) { p.accumulators[1].variance_sum = INFINITY; }), where);
    EXPECT_EQ(refusal([](auto& p) { p.accumulators[1].sample_count = 127; }), where);
    EXPECT_EQ(refusal([](auto& p) { p.accumulators[1].back_face_count = 129; }), where);
    EXPECT_EQ(refusal([](auto& p) { p.accumulators[1].round_count = 2; }), where);
    EXPECT_EQ(refusal([](auto& p) { p.accumulators[1].round_count = ~uint64_t{0}; }), where);
    EXPECT_EQ(refusal([](auto& p) { p.accumulators[1] = {}; }), where);
    EXPECT_EQ(refusal([](auto& p) { p.accumulators[1].cut.last_radiance.y = NAN; }), where);
    EXPECT_EQ(refusal([](auto& p) { p.accumulators[1].cut.cut_throughput = -1.0; }), where);
}

TEST_F(PartialBakes, RefusesPartsOfVersionsWithOtherTallies) {
    const auto sound = open_probe_file(bake_part("sound", {3, 9}));
    ASSERT_TRUE(sound);
    const std::vector<std::byte> tallies(6 * 256);
    constexpr uint64_t kPartSize = 56;
    const std::vector<ExtraSection> sections{
        {"part", *sound->section_bytes("part", kPartSize), kPartSize}, {"tallies", tallies, 256}};
    ASSERT_TRUE(write_probe_file(path("old"), sound->view(), sections));
    const auto part = read_part(path("old"));
    ASSERT_FALSE(part);
    EXPECT_EQ(part.error().code, ErrorCode::Unsupported);
    EXPECT_EQ(error_text(part.error()),
              path("old") +
                  ": another version of the program wrote this part (its elements have "
                  "256 bytes instead of 296); bake it again");
}

TEST_F(PartialBakes, RefusesRangesThatAreNone) {
    EXPECT_EQ(refusal([](auto& p) {
                  p.range = {30, 36};
              }),
              path("bad") + ": probes 30..36 are out of range (there are 35)");
}

TEST_F(PartialBakes, RefusesAFileCutOrChangedAnywhere) {
    const std::string sound = bake_part("sound", {3, 9});
    std::ifstream stream(sound, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
    for (size_t i = 0; i < bytes.size(); i += 61) {
        std::ofstream(path("cut"), std::ios::binary) << bytes.substr(0, i);
        EXPECT_FALSE(read_part(path("cut"))) << i;
        std::string changed = bytes;
        changed[i] = static_cast<char>(~changed[i]);
        std::ofstream(path("changed"), std::ios::binary) << changed;
        EXPECT_FALSE(read_part(path("changed"))) << i;
    }
}

}  // namespace
}  // namespace tetralight
