// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/seed_grid.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include <tetralight/probes/build/make_seeds.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/probe_file.h>
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

std::vector<uint32_t> make_grid(const SeedGridHeader& header, std::vector<uint32_t> voxels) {
    std::vector<uint32_t> words(kSeedGridHeaderWords);
    std::memcpy(words.data(), &header, sizeof header);
    words.insert(words.end(), voxels.begin(), voxels.end());
    return words;
}

constexpr SeedGridHeader kLine{{0, 0, 0}, {1, 0, 0}, {3, 1, 1}};

TEST(SeedGrid, NamesTheVoxelOfAPositionAndTheNearestOneOutside) {
    const auto words = make_grid(kLine, {7, 8, 9});
    const auto cell = [&](float x) {
        const glm::vec3 local(x, 5, -5);
        return seed_cell(words, seed_word(kLine, 0, local), local);
    };
    EXPECT_EQ(cell(0.5f), 7u);
    EXPECT_EQ(cell(1.5f), 8u);
    EXPECT_EQ(cell(2.5f), 9u);
    EXPECT_EQ(cell(-1e30f), 7u);
    EXPECT_EQ(cell(std::numeric_limits<float>::infinity()), 9u);
    EXPECT_EQ(cell(std::numeric_limits<float>::quiet_NaN()), 7u);
}

TEST(SeedGrid, GoesOnInAFinerGrid) {
    auto words = make_grid(kLine, {7, kFinerGrid | 13, 9});
    const auto finer = make_grid({{1, 0, 0}, {2, 0, 0}, {2, 1, 1}}, {20, 21});
    words.insert(words.end(), finer.begin(), finer.end());
    const auto cell = [&](float x) { return words[find_seed_word(words, {x, 0, 0})]; };
    EXPECT_EQ(cell(0.5f), 7u);
    EXPECT_EQ(cell(1.2f), 20u);
    EXPECT_EQ(cell(1.7f), 21u);
}

TEST(SeedGrid, EndsWhereAGridNamesItself) {
    const auto words = make_grid(kLine, {7, kFinerGrid, kFinerGrid | 0x7fffffffu});
    EXPECT_EQ(find_seed_word(words, {1.5f, 0, 0}), words.size());
    EXPECT_EQ(find_seed_word(words, {2.5f, 0, 0}), words.size());
}

TEST(SeedGrid, OfAnyBytesLeadsToTheSameLight) {
    const ProbeVolume sound = test::make_lit_volume(test::random_positions(200, 1));
    std::vector<glm::vec3> positions;
    for (const auto& p : test::random_positions(100, 2, 1.5)) positions.emplace_back(p);
    std::mt19937_64 engine(3);
    for (int i = 0; i < 300; ++i) {
        ProbeVolume volume = sound;
        const size_t kept = engine() % 2 ? volume.seed_grid.size() : engine() % 40;
        volume.seed_grid.resize(kept);
        volume.seed_grid.shrink_to_fit();
        for (int k = 0; k < 20 && kept > 0; ++k) {
            const size_t word =
                engine() % 2 ? engine() % kept : engine() % std::min<size_t>(kept, 16);
            volume.seed_grid[word] = static_cast<uint32_t>(engine() >> (engine() % 64));
        }
        std::vector<CellLocation> locations(positions.size());
        locate(volume.view(), positions, locations);
        for (size_t k = 0; k < positions.size(); ++k) {
            EXPECT_EQ(locations[k], locate(volume.view(), positions[k]));
            const auto expected = interpolate(sound.view(), locate(sound.view(), positions[k]));
            const auto light = interpolate(sound.view(), locations[k]);
            const glm::vec3 off =
                light.irradiance.coefficients[0] - expected.irradiance.coefficients[0];
            ASSERT_LE(glm::length(off), 1e-5f);
        }
    }
}

class VerifySeedGrid : public testing::Test {
  protected:
    ProbeVolume volume = test::make_lit_volume(test::random_positions(100, 4));

    [[nodiscard]] std::string field() const {
        const auto status = verify(volume.view());
        return status ? "" : status.error().field;
    }
};

TEST_F(VerifySeedGrid, AcceptsAVolumeWithAndWithoutOne) {
    EXPECT_EQ(field(), "");
    volume.seed_grid.clear();
    EXPECT_EQ(field(), "");
}

TEST_F(VerifySeedGrid, AcceptsSeedsBesideItAndReadsNone) {
    make_seeds(volume);
    EXPECT_EQ(field(), "");
    const glm::vec3 position(0.1f, 0.2f, 0.3f);
    const LocationTrace trace = trace_location(volume.view(), position);
    for (Seed& seed : volume.seeds) seed.cell = 0;
    EXPECT_EQ(trace_location(volume.view(), position).step_count, trace.step_count);
}

TEST_F(VerifySeedGrid, RefusesACellOutOfRange) {
    volume.seed_grid.back() = static_cast<uint32_t>(volume.cells.size());
    EXPECT_EQ(field(), "seed_grid[" + std::to_string(volume.seed_grid.size() - 1) + "]");
}

TEST_F(VerifySeedGrid, RefusesASectionThatIsCutOff) {
    const std::vector<uint32_t> whole = volume.seed_grid;
    for (const size_t size : {size_t{1}, size_t{9}, size_t{10}, whole.size() - 1}) {
        volume.seed_grid.assign(whole.begin(), whole.begin() + static_cast<ptrdiff_t>(size));
        EXPECT_EQ(field(), "seed_grid") << size;
    }
    volume.seed_grid = whole;
    volume.seed_grid.push_back(0);
    EXPECT_EQ(field(), "seed_grid");
}

TEST_F(VerifySeedGrid, RefusesEachBadWordOfAHeader) {
    const std::vector<uint32_t> whole = volume.seed_grid;
    for (size_t word = 0; word < kSeedGridHeaderWords; ++word) {
        volume.seed_grid = whole;
        volume.seed_grid[word] = 0xffffffffu;  // as a float not a number
        EXPECT_EQ(field(), "seed_grid") << word;
    }
}

TEST(SeedGrid, MayBeNamedBySeveralVoxelsOfOneLevel) {
    const ProbeVolume sound = test::make_lit_volume(test::random_positions(100, 4));
    ProbeVolume volume = sound;
    volume.seed_grid = make_grid(kLine, {7, kFinerGrid | 13, kFinerGrid | 13});
    const auto finer = make_grid({{1, 0, 0}, {2, 0, 0}, {2, 1, 1}}, {20, kFinerGrid | 25});
    const auto finest = make_grid({{1, 0, 0}, {2, 0, 0}, {1, 1, 1}}, {21});
    volume.seed_grid.insert(volume.seed_grid.end(), finer.begin(), finer.end());
    volume.seed_grid.insert(volume.seed_grid.end(), finest.begin(), finest.end());
    EXPECT_TRUE(verify(volume.view()));
    volume.seed_grid[10] = kFinerGrid | 25;  // of the third level
    EXPECT_FALSE(verify(volume.view()));
}

TEST_F(VerifySeedGrid, RefusesLinksBackAndLinksToNothing) {
    const size_t word = kSeedGridHeaderWords + 3;
    volume.seed_grid[word] = kFinerGrid;
    EXPECT_EQ(field(), "seed_grid[" + std::to_string(word) + "]");
    volume.seed_grid[word] = kFinerGrid | 0x7fffffffu;
    EXPECT_EQ(field(), "seed_grid");
}

}  // namespace
}  // namespace tetralight
