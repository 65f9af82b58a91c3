// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/preview_volume.h>

#include <algorithm>

#include <tetralight/pipeline/dilate_probes.h>
#include <tetralight/pipeline/reuse_probes.h>
#include "tests/pipeline/part_fixture.h"

namespace tetralight::test {
namespace {

class PreviewVolume : public PartFixture {
  protected:
    const PlaceRange all{0, kProbeCount};

    [[nodiscard]] static BakedVolume finish(PreparedBake prepared, const PartialBake& part) {
        return finish_bake(std::move(prepared), part.accumulators, part.split_rows);
    }
};

TEST_F(PreviewVolume, OfAllSamplesIsTheVolumeButForItsMetadata) {
    lighting.layers = {"sky"};
    const PartialBake part = bake(prepare(), all);
    ProbeVolume preview = preview_volume(prepare(), part);
    const ProbeVolume finished = finish(prepare(), part).volume;
    EXPECT_EQ(preview.metadata, R"({"is_preview":true})");
    preview.metadata = finished.metadata;
    EXPECT_EQ(probe_file_bytes(preview.view()), probe_file_bytes(finished.view()));
}

TEST_F(PreviewVolume, ProbesWithoutSamplesHaveTheLightOfTheirNeighbors) {
    const PreparedBake prepared = prepare();
    PartialBake part = bake(prepared, all);
    std::vector<bool> is_unknown(kProbeCount);
    for (size_t i = 0; i < kProbeCount; i += 3) {
        part.accumulators[i] = {};
        is_unknown[i] = true;
    }
    const ProbeVolume preview = preview_volume(prepared, part);
    EXPECT_TRUE(verify(preview.view()));
    ProbeVolume expected = finish(prepare(), part).volume;
    dilate_probes(is_unknown, expected);
    for (size_t i = 0; i < kProbeCount; ++i) {
        EXPECT_GT(preview.irradiance[i].coefficients[0].g, 0.0f) << i;
        if (groups[1].dering && i >= 20) continue;  // ringing is removed after probes are dilated
        EXPECT_EQ(preview.irradiance[i], expected.irradiance[i]) << i;
    }
}

TEST_F(PreviewVolume, BeforeAnySampleIsDark) {
    const PreparedBake prepared = prepare();
    const PartialBake none{all, std::vector<ProbeAccumulator>(kProbeCount)};
    const ProbeVolume preview = preview_volume(prepared, none);
    EXPECT_TRUE(verify(preview.view()));
    EXPECT_TRUE(std::ranges::all_of(preview.irradiance,
                                    [](const IrradianceSh& sh) { return sh == IrradianceSh{}; }));
}

TEST_F(PreviewVolume, IsShownWhileARangeIsBaked) {
    settings.sample_count = 1 << 12;
    const PreparedBake prepared = prepare();
    uint32_t shown = 0;
    uint64_t last_samples = 0;
    const auto baked =
        bake_range(scene, prepared, all, {}, {},
                   {.show =
                        [&](const PartialBake& so_far) {
                            uint64_t samples = 0;
                            for (const auto& sums : so_far.accumulators)
                                samples += sums.sample_count;
                            EXPECT_GT(samples, last_samples);
                            last_samples = samples;
                            EXPECT_TRUE(verify(preview_volume(prepared, so_far).view()));
                            ++shown;
                        },
                    .seconds = 0.0});
    ASSERT_TRUE(baked);
    EXPECT_GT(shown, 0u);
    EXPECT_EQ(probe_file_bytes(finish(prepare(), baked->partial).volume.view()), whole());
}

}  // namespace
}  // namespace tetralight::test
