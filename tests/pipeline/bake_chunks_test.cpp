// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/error_text.h>
#include <tetralight/pipeline/bake_chunks.h>

#include <fstream>

#include "tests/pipeline/part_fixture.h"

namespace tetralight {
namespace {

namespace fs = std::filesystem;

class BakeChunks : public test::PartFixture {
  protected:
    const std::string chunks = path("chunks");

    [[nodiscard]] std::vector<fs::path> files() const {
        std::vector<fs::path> found;
        for (const auto& entry : fs::directory_iterator(chunks)) found.push_back(entry.path());
        std::ranges::sort(found);
        return found;
    }

    /// Bakes to the end and checks the bytes; gives the rays that were traced before.
    uint64_t finish() const {
        PreparedBake prepared = prepare();
        const auto baked = bake_in_chunks(scene, prepared, chunks);
        EXPECT_TRUE(baked) << error_text(baked.error());
        const BakedVolume volume = finish_bake(std::move(prepared), baked->partial.accumulators,
                                               baked->partial.split_rows);
        EXPECT_EQ(probe_file_bytes(volume.volume.view()), whole());
        return baked->earlier_ray_count;
    }
};

TEST_F(BakeChunks, GiveTheBytesOfABakeInOnePiece) {
    EXPECT_EQ(finish(), 0u);
    const std::vector<fs::path> expected{
        chunks + "/0-16-of-35.chunk", chunks + "/16-32-of-35.chunk", chunks + "/32-35-of-35.chunk"};
    EXPECT_EQ(files(), expected);
}

TEST_F(BakeChunks, AreNotBakedTwice) {
    finish();
    const PreparedBake prepared = prepare();
    const auto again = bake_in_chunks(scene, prepared, chunks, [](const BakeProgress&) {
        ADD_FAILURE() << "nothing is left to do";
        return true;
    });
    ASSERT_TRUE(again);
    EXPECT_GT(again->earlier_ray_count, 0u);
    finish();
}

TEST_F(BakeChunks, CancelledOnesGoOnWithWhatIsFinished) {
    settings.sample_count = 1 << 13;
    const auto cancelled =
        bake_in_chunks(scene, prepare(), chunks,
                       [](const BakeProgress& progress) { return progress.probes_done < 20; });
    ASSERT_FALSE(cancelled);
    EXPECT_EQ(cancelled.error().code, ErrorCode::Cancelled);
    EXPECT_EQ(files().size(), 1u);
    EXPECT_GT(finish(), 0u);
}

TEST_F(BakeChunks, AnyMissingAndTornAndChangedOnesAreBakedAnew) {
    finish();
    const auto all = files();
    fs::remove(all[0]);
    fs::resize_file(all[1], fs::file_size(all[1]) - 1);
    std::fstream(all[2], std::ios::in | std::ios::out | std::ios::binary).seekp(100).put('\x55');
    EXPECT_EQ(finish(), 0u);
    EXPECT_EQ(files(), all);
}

TEST_F(BakeChunks, OfAnotherBakeAreBakedAnew) {
    finish();
    settings.seed = 9;
    EXPECT_EQ(finish(), 0u);
}

TEST_F(BakeChunks, KeepWhatLightIsSplitInto) {
    lighting.layers = {"sky", "transfer"};
    finish();
    fs::remove(files()[1]);
    EXPECT_GT(finish(), 0u);
}

TEST_F(BakeChunks, CountProbesOfAllChunks) {
    size_t done = 0;
    const auto baked = bake_in_chunks(scene, prepare(), chunks, [&](const BakeProgress& progress) {
        EXPECT_EQ(progress.probe_count, kProbeCount);
        EXPECT_GE(progress.probes_done, done);
        EXPECT_LE(progress.fraction_done, 1.0);
        done = progress.probes_done;
        return true;
    });
    ASSERT_TRUE(baked);
    EXPECT_EQ(done, kProbeCount);
}

TEST_F(BakeChunks, ThatCannotBeWrittenAreAnError) {
    std::ofstream(chunks) << "a file";
    const auto baked = bake_in_chunks(scene, prepare(), chunks);
    ASSERT_FALSE(baked);
    EXPECT_EQ(error_text(baked.error()).find(chunks + ": cannot make the folder"), 0u);
}

}  // namespace
}  // namespace tetralight
