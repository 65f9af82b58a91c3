// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/error_text.h>
#include <tetralight/pipeline/write_lppv.h>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <gtest/gtest.h>

#include <cstring>

#include "tests/support/random_probes.h"
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

Lppv make_test_lppv() {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(50, 1, 3.0));
    volume.occlusion.assign(volume.positions.size(), glm::vec4(0.5f));
    const LppvPart box{glm::dmat4(1.0), glm::dvec3(-1.0), glm::dvec3(1.0)};
    LppvSettings settings;
    settings.resolution_mode = LppvResolution::Custom;
    settings.resolution = {3, 4, 5};
    return *make_lppv(volume.view(),
                      *make_lppv_grid({glm::dmat4(1.0), std::span(&box, 1)}, settings), {});
}

TEST(WriteLppv, ExrHasAChannelForEachValueAndSlicesSideBySide) {
    const TempFolder folder;
    const Lppv lppv = make_test_lppv();
    const std::string path = folder.path("a.exr");
    ASSERT_TRUE(write_lppv(path, lppv, {LppvFileKind::OpenExr, LppvTexelFormat::Float}));
    Imf::InputFile file(path.c_str());
    size_t channels = 0;
    for (auto it = file.header().channels().begin(); it != file.header().channels().end(); ++it) {
        ++channels;
    }
    EXPECT_EQ(channels, 27u + 1u + 4u);
    constexpr int kWidth = 15;
    std::vector<float> values(kWidth * 4);
    Imf::FrameBuffer target;
    target.insert("sh5.G", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()),
                                      sizeof(float), kWidth * sizeof(float)));
    file.setFrameBuffer(target);
    file.readPixels(0, 3);
    for (uint32_t i = 0; i < 60; ++i) {
        const glm::uvec3 point(i % 3, i / 3 % 4, i / 12);
        EXPECT_EQ(values[point.y * kWidth + point.z * 3 + point.x],
                  lppv.irradiance[lppv.grid.point_index(point)].coefficients[5].g);
    }
}

TEST(WriteLppv, TexturesHoldTheTexels) {
    const TempFolder folder;
    const Lppv lppv = make_test_lppv();
    const auto texture = make_lppv_texture(lppv, LppvLayout::FourSlabs, LppvTexelFormat::Half);
    for (const auto kind : {LppvFileKind::Dds, LppvFileKind::Ktx2}) {
        ASSERT_TRUE(write_lppv(folder.path("a"), lppv,
                               {kind, LppvTexelFormat::Half, LppvLayout::FourSlabs}));
        const auto bytes = *read_file(folder.path("a"));
        ASSERT_GT(bytes.size(), texture.texels.size());
        EXPECT_EQ(std::memcmp(&bytes[bytes.size() - texture.texels.size()], texture.texels.data(),
                              texture.texels.size()),
                  0);
    }
}

TEST(WriteLppv, KindsFollowTheExtension) {
    EXPECT_EQ(lppv_file_kind("a.b/c"), LppvFileKind::OpenVdb);
    EXPECT_EQ(lppv_file_kind("a.VDB"), LppvFileKind::OpenVdb);
    EXPECT_EQ(lppv_file_kind("a.nvdb"), LppvFileKind::NanoVdb);
    EXPECT_EQ(lppv_file_kind("a.exr"), LppvFileKind::OpenExr);
    EXPECT_EQ(lppv_file_kind("a.dds"), LppvFileKind::Dds);
    EXPECT_EQ(lppv_file_kind("a.ktx2"), LppvFileKind::Ktx2);
    EXPECT_EQ(lppv_file_kind("a.png"), std::nullopt);
}

TEST(WriteLppv, AFullDiskLeavesNothing) {
    const Lppv lppv = make_test_lppv();
    for (const auto kind : {LppvFileKind::OpenVdb, LppvFileKind::NanoVdb, LppvFileKind::OpenExr,
                            LppvFileKind::Dds, LppvFileKind::Ktx2}) {
        const auto status = write_lppv("/dev/full", lppv, {kind});
        ASSERT_FALSE(status);
        EXPECT_NE(error_text(status.error()).find("/dev/full: cannot write"), std::string::npos);
    }
}

}  // namespace
}  // namespace tetralight
