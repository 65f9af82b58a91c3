// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/bake_range.h>

#include <fstream>
#include <optional>
#include <random>

#include <tetralight/pipeline/merge_parts.h>
#include <tetralight/pipeline/reuse_probes.h>
#include "tests/pipeline/part_fixture.h"

namespace tetralight {
namespace {

namespace fs = std::filesystem;

class BakeRange : public test::PartFixture {
  protected:
    const PlaceRange all{0, kProbeCount};

    [[nodiscard]] BakeStore open(const std::string& name) const {
        auto store = BakeStore::open(path(name));
        EXPECT_TRUE(store) << error_text(store.error());
        return std::move(*store);
    }

    static BakeStorage saved_often(BakeStore& store) {
        return {.sources = {&store},
                .target = &store,
                .save_seconds = 0.0,
                .is_saved_at_end = true,
                .is_required = true};
    }

    /// The bytes of the volume that a finished bake of all probes gives.
    static std::vector<std::byte> bytes(PreparedBake prepared, const RangeBake& baked) {
        const auto& part = baked.partial;
        const BakedVolume volume =
            finish_bake(std::move(prepared), part.accumulators, part.split_rows);
        return probe_file_bytes(volume.volume.view());
    }

    /// Bakes to the end with a store of this name; gives the rays of earlier runs.
    uint64_t finish(const std::string& name) const {
        BakeStore store = open(name);
        PreparedBake prepared = prepare();
        const auto baked = bake_range(scene, prepared, all, saved_often(store));
        EXPECT_TRUE(baked) << error_text(baked.error());
        EXPECT_EQ(bytes(std::move(prepared), *baked), whole());
        return baked->stored.earlier_ray_count;
    }
};

TEST_F(BakeRange, DoesNotBakeTwice) {
    EXPECT_EQ(finish("store"), 0u);
    BakeStore store = open("store");
    const auto again = bake_range(scene, prepare(), all, saved_often(store));
    ASSERT_TRUE(again);
    EXPECT_FALSE(again->stored.is_saved && !again->stored.earlier_ray_count);
    uint64_t ray_count = 0;
    for (const auto& accumulator : again->partial.accumulators) ray_count += accumulator.ray_count;
    EXPECT_EQ(again->stored.earlier_ray_count, ray_count);
}

TEST_F(BakeRange, ContinuesWhereItWasCancelled) {
    settings.sample_count = 1024;
    settings.target_error = 0.001;
    settings.max_sample_count = 1 << 14;
    PreparedBake prepared = prepare();
    std::optional<RangeBake> baked;
    for (int run = 0; !baked; ++run) {
        BakeStore store = open("store");
        int left = run == 0 ? 1 : 3;
        auto result = bake_range(scene, prepared, all, {.sources = {&store}, .target = &store},
                                 [&](const BakeProgress&) { return --left > 0; });
        if (result) {
            EXPECT_GT(run, 0);
            baked = std::move(*result);
        } else {
            EXPECT_EQ(result.error().code, ErrorCode::Cancelled);
        }
    }
    EXPECT_GT(baked->stored.earlier_ray_count, 0u);
    EXPECT_EQ(bytes(std::move(prepared), *baked), whole());
}

TEST_F(BakeRange, TakesProbesOfOtherGroupsAndRanges) {
    static_cast<void>(finish("store"));
    groups[0].positions.pop_back();
    groups.push_back({});
    groups.back().name = "cellar";
    groups.back().positions = {{0.1, 0.2, 0.3}};
    BakeStore store = open("store");
    PreparedBake prepared = prepare();
    const auto baked = bake_range(scene, prepared, {3, kProbeCount}, saved_often(store));
    ASSERT_TRUE(baked);
    EXPECT_GT(baked->stored.earlier_ray_count, 0u);
}

TEST_F(BakeRange, TakesNothingOfAnotherBake) {
    EXPECT_EQ(finish("store"), 0u);
    settings.seed = 9;
    EXPECT_EQ(finish("store"), 0u);
    scene.environment.radiance.x += 1e-6f;
    EXPECT_EQ(finish("store"), 0u);
    settings.seed = 0;
    scene.environment.radiance.x = 1.0f;
    EXPECT_GT(finish("store"), 0u);
}

TEST_F(BakeRange, ThatCannotBeSavedGoesOnAndSaysSo) {
    std::ofstream(path("file")) << "a file";
    BakeStore store = open("file/store");
    BakeStorage storage = saved_often(store);
    storage.is_required = false;
    const auto baked = bake_range(scene, prepare(), all, storage);
    ASSERT_TRUE(baked);
    EXPECT_FALSE(baked->stored.is_saved);
    EXPECT_TRUE(baked->stored.save_failure);
    EXPECT_FALSE(bake_range(scene, prepare(), all, saved_often(store)));
}

TEST_F(BakeRange, RefusesARangeBeyondTheProbes) {
    const auto baked = bake_range(scene, prepare(), {30, 36});
    ASSERT_FALSE(baked);
    EXPECT_EQ(baked.error().field, "probes");
    EXPECT_EQ(error_text(baked.error()), "probes 30..36: there are 35 probes");
}

/// Random ways to the same volume.
class AnyWay : public BakeRange {
  protected:
    explicit AnyWay() {
        scene.environment.radiance = {1, 2, 3};
        Light& lamp = test::add_point_light(scene, LightMode::Mixed, {3, 2, 1}, {1, 1, 1});
        lamp.radius = 0.1f;
        scene.light_names = {"bulb", "lamp"};
        settings.sample_count = 64;
        settings.target_error = 0.05;
        settings.max_sample_count = 512;
    }

    bool chance() { return random() % 2 == 0; }

    void damage_store() {
        std::vector<fs::path> packs;
        if (!fs::exists(path("store"))) return;
        for (const auto& file : fs::directory_iterator(path("store"))) {
            if (file.path().extension() == ".pack") packs.push_back(file.path());
        }
        if (packs.empty()) return;
        std::fstream file(packs[random() % packs.size()],
                          std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(static_cast<std::streamoff>(random() % 3000));
        file.put(static_cast<char>(random()));
    }

    /// Bakes a range of a prepared bake: with stores or not, cancelled or not.
    RangeBake bake_any(const PreparedBake& prepared, PlaceRange range) {
        while (true) {
            if (chance()) damage_store();
            BakeStore store = open("store"), other = open("other");
            BakeStorage storage;
            if (chance()) storage = saved_often(store);
            if (chance()) storage.sources.push_back(&other);
            size_t left = chance() ? 1 + random() % 4 : 1u << 30;
            auto baked = bake_range(scene, prepared, range, storage,
                                    [&](const BakeProgress&) { return --left > 0; });
            if (baked) return std::move(*baked);
            EXPECT_EQ(baked.error().code, ErrorCode::Cancelled);
        }
    }

    PreparedBake prepare_any(const ProbeVolume& old) {
        settings.thread_count = 1 + static_cast<uint32_t>(random() % 4);
        PreparedBake prepared = prepare();
        if (chance()) {
            const auto status = reuse_probes(old.view(), prepared);
            EXPECT_TRUE(status) << error_text(status.error());
        }
        return prepared;
    }

    std::vector<std::byte> bake_in_parts(const ProbeVolume& old) {
        std::vector<std::string> parts;
        for (uint32_t begin = 0; begin < kProbeCount;) {
            const uint32_t end =
                std::min(kProbeCount, begin + 1 + static_cast<uint32_t>(random() % kProbeCount));
            const PreparedBake prepared = prepare_any(old);
            parts.push_back(path("part" + std::to_string(parts.size())));
            const auto baked = bake_any(prepared, {begin, end});
            const auto written = write_part(parts.back(), prepared, baked.partial);
            EXPECT_TRUE(written) << error_text(written.error());
            begin = end;
        }
        const auto merged = merge_parts(parts);
        EXPECT_TRUE(merged) << error_text(merged.error());
        return probe_file_bytes(merged->volume.view());
    }

    std::vector<std::byte> bake_at_once(const ProbeVolume& old) {
        PreparedBake prepared = prepare_any(old);
        const RangeBake baked = bake_any(prepared, all);
        return bytes(std::move(prepared), baked);
    }

    void expect_the_same_bytes() {
        const auto positions = groups[0].positions;
        groups[0].positions[3].x += 0.25;
        groups[0].positions[7].y -= 0.25;
        auto old = bake_volume(scene, groups, {{}, settings, {}, {}, lighting});
        ASSERT_TRUE(old);
        {
            BakeStore other = open("other");
            ASSERT_TRUE(bake_range(scene, prepare(), {5, 20}, saved_often(other)));
        }
        groups[0].positions = positions;
        const std::vector<std::byte> expected = whole();
        for (int run = 0; run < 25; ++run) {
            if (chance()) fs::remove_all(path("store"));
            const auto found = chance() ? bake_at_once(old->volume) : bake_in_parts(old->volume);
            EXPECT_EQ(found, expected) << run;
        }
    }

    std::mt19937 random{7};
};

TEST_F(AnyWay, GivesTheSameBytes) {
    expect_the_same_bytes();
}

TEST_F(AnyWay, GivesTheSameBytesWithLightGroups) {
    lighting.mixed_lighting = MixedLighting::Shadowmask;
    lighting.layers = {"light:bulb", "transfer"};
    expect_the_same_bytes();
}

}  // namespace
}  // namespace tetralight
