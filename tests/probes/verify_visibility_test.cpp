// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include <tetralight/probes/edge_visibility.h>
#include <tetralight/probes/probe_file.h>
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

/// Marks every third cell; its first edge is blocked, all others are free.
ProbeVolume make_volume(std::vector<glm::dvec3> positions) {
    ProbeVolume volume = test::make_lit_volume(std::move(positions));
    volume.visibility_blocks.resize((volume.cells.size() + 31) / 32);
    for (uint32_t cell = 0; cell < volume.cells.size(); ++cell) {
        VisibilityBlock& block = volume.visibility_blocks[cell / 32];
        if (cell % 32 == 0) block.first = static_cast<uint32_t>(volume.cell_visibility.size());
        const auto& vertices = volume.cells[cell].vertices;
        if (cell % 3 != 0 || vertices[1] == kNoIndex) continue;
        block.cells |= uint32_t{1} << (cell % 32);
        CellVisibility& codes = volume.cell_visibility.emplace_back();
        for (size_t i = 0; i < 4; ++i) {
            for (size_t j = 0; j < 4; ++j) {
                const bool is_edge = vertices[i] != kNoIndex && vertices[j] != kNoIndex && i != j;
                if (is_edge) codes.codes[edge_place(i, j)] = kFreeEdge;
            }
        }
        codes.codes[edge_place(0, 1)] = 100;
    }
    return volume;
}

class VerifyVisibility : public testing::Test {
  protected:
    ProbeVolume sound = make_volume(test::random_positions(100, 1));

    [[nodiscard]] std::string field_after(const std::function<void(ProbeVolume&)>& change) const {
        ProbeVolume volume = sound;
        change(volume);
        const auto status = verify(volume.view());
        return status ? "" : status.error().field;
    }
};

TEST_F(VerifyVisibility, AcceptsVolumesOfEveryDimension) {
    EXPECT_EQ(field_after([](ProbeVolume&) {}), "");
    for (const glm::dvec3& extent : {glm::dvec3(1, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(0)}) {
        std::vector<glm::dvec3> positions = test::random_positions(30, 2);
        for (glm::dvec3& position : positions) position *= extent;
        EXPECT_TRUE(verify(make_volume(positions).view()));
    }
}

TEST_F(VerifyVisibility, RefusesAWrongNumberOfElements) {
    EXPECT_EQ(field_after([](ProbeVolume& v) { v.visibility_blocks.pop_back(); }),
              "visibility_blocks");
    EXPECT_EQ(field_after([](ProbeVolume& v) { v.visibility_blocks.clear(); }),
              "visibility_blocks");
    EXPECT_EQ(field_after([](ProbeVolume& v) { v.cell_visibility.pop_back(); }), "cell_visibility");
    EXPECT_EQ(
        field_after([](ProbeVolume& v) { v.cell_visibility.push_back(v.cell_visibility.back()); }),
        "cell_visibility");
}

TEST_F(VerifyVisibility, RefusesBlocksThatBeginElsewhere) {
    EXPECT_EQ(field_after([](ProbeVolume& v) { ++v.visibility_blocks[1].first; }),
              "visibility_blocks[1]");
    EXPECT_EQ(field_after([](ProbeVolume& v) { v.visibility_blocks[0].cells ^= 2; }),
              "visibility_blocks[1]");
}

TEST_F(VerifyVisibility, RefusesCellsThatDoNotExist) {
    ASSERT_NE(sound.cells.size() % 32, 0u);
    const size_t last = sound.visibility_blocks.size() - 1;
    EXPECT_EQ(field_after([](ProbeVolume& v) { v.visibility_blocks.back().cells |= 1u << 31; }),
              "visibility_blocks[" + std::to_string(last) + "]");
}

TEST_F(VerifyVisibility, RefusesElementsThatAreFree) {
    EXPECT_EQ(field_after([](ProbeVolume& v) { v.cell_visibility[2].codes.fill(kFreeEdge); }),
              "cell_visibility[2]");
}

TEST_F(VerifyVisibility, RefusesSplitsOfEdgesThatAreNotBlocked) {
    const auto after = [this](uint32_t bits) {
        return field_after([bits](ProbeVolume& v) {
            CellVisibility& cell = v.cell_visibility[2];
            cell.codes[edge_place(0, 2)] = 90;
            cell.splits = {static_cast<uint8_t>(bits), static_cast<uint8_t>(bits >> 8)};
        });
    };
    EXPECT_EQ(after(split_bit(0, 1, 2)), "");
    EXPECT_EQ(after(split_bit(0, 1, 3)), "cell_visibility[2]");
    EXPECT_EQ(after(split_bit(1, 0, 2)), "cell_visibility[2]");
    EXPECT_EQ(after(1u << 12), "cell_visibility[2]");
}

TEST_F(VerifyVisibility, RefusesCodesOfEdgesThatHullCellsDoNotHave) {
    const size_t last = sound.cell_visibility.size() - 1;
    EXPECT_EQ(field_after([](ProbeVolume& v) {
                  v.cell_visibility.back().codes[edge_place(3, 0)] = kFreeEdge;
              }),
              "cell_visibility[" + std::to_string(last) + "]");
}

TEST_F(VerifyVisibility, IsKeptByAFile) {
    const std::string path = testing::TempDir() + "tetralight_visibility.probes";
    ASSERT_TRUE(write_probe_file(path, sound.view()));
    const auto file = open_probe_file(path);
    ASSERT_TRUE(file);
    EXPECT_EQ(copy_volume(file->view()), sound);
}

}  // namespace
}  // namespace tetralight
