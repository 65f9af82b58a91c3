// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/error_text.h>
#include <tetralight/pipeline/resumable_bake.h>

#include <fstream>

#include "tests/pipeline/part_fixture.h"

namespace tetralight {
namespace {

class ResumableBake : public test::PartFixture {
  protected:
    ResumableBake() { settings.sample_count = 1 << 14; }

    const ProbeRange all{0, kProbeCount};

    void expect_whole(PreparedBake prepared, const RangeBake& baked) const {
        const BakedVolume volume = finish_bake(std::move(prepared), baked.partial.accumulators);
        EXPECT_EQ(probe_file_bytes(volume.volume.view()), whole());
    }

    /// Cancels a bake again and again, until it ends by itself.
    RangeBake bake_in_many_runs(const PreparedBake& prepared, const std::string& file) const {
        for (int run = 0;; ++run) {
            int left = run == 0 ? 1 : 3;  // the first one gets nowhere on a machine of any speed
            auto baked = bake_range(scene, prepared, all, {file, true},
                                    [&](const BakeProgress&) { return --left > 0; });
            if (baked) {
                EXPECT_GT(run, 0);
                return std::move(*baked);
            }
            EXPECT_EQ(baked.error().code, ErrorCode::Cancelled);
            EXPECT_TRUE(std::filesystem::exists(file));
        }
    }
};

TEST_F(ResumableBake, CancelledAndResumedGivesTheBytesOfOneBake) {
    PreparedBake prepared = prepare();
    const RangeBake baked = bake_in_many_runs(prepared, path("kept"));
    EXPECT_TRUE(baked.is_kept);
    EXPECT_TRUE(baked.partial.is_finished);
    EXPECT_GT(baked.earlier_ray_count, 0u);
    expect_whole(std::move(prepared), baked);
}

TEST_F(ResumableBake, AdaptiveOnesToo) {
    settings.sample_count = 1024;
    settings.target_error = 0.001;
    settings.max_sample_count = 1 << 14;
    PreparedBake prepared = prepare();
    const RangeBake baked = bake_in_many_runs(prepared, path("kept"));
    expect_whole(std::move(prepared), baked);
}

TEST_F(ResumableBake, IsKeptOnItsWay) {
    settings.sample_count = 1 << 18;
    scene.instances.clear();
    const auto baked = bake_range(scene, prepare(), all, {path("kept"), false, 0.0});
    ASSERT_TRUE(baked);
    EXPECT_TRUE(baked->is_kept);
    EXPECT_EQ(baked->warning, "");
    const auto part = read_part(path("kept"));
    ASSERT_TRUE(part) << error_text(part.error());
    EXPECT_GT(part->partial.begun_count(), 0u);
    EXPECT_FALSE(part->partial.is_finished);
}

TEST_F(ResumableBake, ThatCannotBeKeptGoesOnAndSaysSo) {
    const auto baked = bake_range(scene, prepare(), all, {path("none/kept"), false, 0.0});
    ASSERT_TRUE(baked);
    EXPECT_TRUE(baked->partial.is_finished);
    EXPECT_FALSE(baked->is_kept);
    EXPECT_EQ(baked->warning.find(path("none/kept") + ": cannot write"), 0u) << baked->warning;
}

TEST_F(ResumableBake, RefusesWhatIsKeptOfAnotherBakeOrRange) {
    static_cast<void>(bake_part("kept", {3, 9}));
    const auto other_range = bake_range(scene, prepare(), {3, 10}, {path("kept"), true});
    ASSERT_FALSE(other_range);
    EXPECT_EQ(error_text(other_range.error()),
              path("kept") + ": is of probes 3..9, not of probes 3..10");
    settings.seed = 1;
    const auto other_bake = bake_range(scene, prepare(), {3, 9}, {path("kept"), true});
    ASSERT_FALSE(other_bake);
    EXPECT_EQ(error_text(other_bake.error()).find(path("kept") + ": is of another bake"), 0u);
}

TEST_F(ResumableBake, RefusesARangeBeyondTheProbes) {
    const auto baked = bake_range(scene, prepare(), {30, 36}, {});
    ASSERT_FALSE(baked);
    EXPECT_EQ(error_text(baked.error()), "probes 30..36: there are 35 probes");
}

}  // namespace
}  // namespace tetralight
