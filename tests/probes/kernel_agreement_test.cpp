// SPDX-License-Identifier: Apache-2.0
// Every way through a batch gives one answer: vector code and its scalar twin, floats and compact
// probes, with hints, without, and sorted.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include <tetralight/probes/build/make_seeds.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/detail/batch_queries.h>
#include "tests/support/adversarial_positions.h"
#include "tests/support/property_volume.h"
#include "tests/support/random_walls.h"
#include "tests/support/sized_families.h"

#ifdef TETRALIGHT_HAS_HIGHWAY
#include <hwy/targets.h>
#endif

namespace tetralight {
namespace {

#ifdef TETRALIGHT_HAS_HIGHWAY
/// Calls `check(name)` with the vector code of each kind of processor that this one can be.
template <class Check>
void for_each_target(Check check) {
    for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        check(hwy::TargetName(target));
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}
#else
template <class Check>
void for_each_target(Check check) {
    check("scalar");
}
#endif

enum class Way { Plain, Hints, Sorted };

struct Answers {
    std::vector<IrradianceSh> irradiance;
    std::vector<glm::vec4> occlusion;

    bool operator==(const Answers&) const = default;
};

/// A set of probes, and positions in it and around it.
struct Case {
    std::string family;
    size_t probe_count = 0;
    size_t position_count = 0;

    friend std::ostream& operator<<(std::ostream& out, const Case& c) {
        return out << c.family << " of " << c.probe_count;
    }
};

class KernelAgreement : public testing::TestWithParam<Case> {
  protected:
    ProbeVolume volume;
    std::vector<glm::vec3> positions;

    void SetUp() override {
        const auto families = test::sized_families();
        const auto family =
            std::ranges::find(families, GetParam().family, &test::SizedFamily::name);
        volume = test::make_random_volume(family->make(GetParam().probe_count, 1), 1);
        std::mt19937_64 engine(2);
        std::uniform_real_distribution<float> share(0.0f, 1.0f);
        for (size_t i = 0; i < volume.positions.size(); ++i) {
            volume.occlusion.emplace_back(share(engine), share(engine), share(engine), 1.0f);
        }
        volume.info.ambient = test::random_light(engine, 1.0f, 2.0f);
        const size_t count = GetParam().position_count;
        if (!volume.positions.empty()) {
            positions = test::AdversarialPositions(volume, 3).make(count);
        } else {
            for (const auto& p : test::random_positions(count, 3)) positions.emplace_back(p);
        }
    }

    Answers answers(Way way, const detail::QueryKernels& kernels) const {
        Answers result{std::vector<IrradianceSh>(positions.size()),
                       std::vector<glm::vec4>(positions.size())};
        InterpolationBatch batch;
        batch.positions = positions;
        batch.irradiance = result.irradiance;
        batch.occlusion = result.occlusion;
        std::vector<uint32_t> hints;
        std::vector<uint64_t> sort_memory;
        if (way == Way::Hints) {
            std::mt19937 engine(4);  // any cell, or none: those of other positions will do
            for (size_t i = 0; i < positions.size(); ++i) {
                hints.push_back(i % 16 == 0 ? static_cast<uint32_t>(engine()) : kNoIndex);
            }
            batch.hints = hints;
        }
        if (way == Way::Sorted) sort_memory.resize(2 * positions.size());
        batch.sort_memory = sort_memory;
        static_cast<void>(detail::answer(volume.view(), batch, kernels));
        return result;
    }

    /// Holds that answers differ by no more than a share of the brightest light.
    static void expect_near(const Answers& a, const Answers& b, float tolerance) {
        for (size_t i = 0; i < a.irradiance.size(); ++i) {
            for (int k = 0; k < kShCoefficientCount; ++k) {
                const glm::vec3& expected = b.irradiance[i].coefficients[k];
                const glm::vec3 off = glm::abs(a.irradiance[i].coefficients[k] - expected);
                const glm::vec3 bound = tolerance * expected;
                ASSERT_TRUE(off.x <= bound.x && off.y <= bound.y && off.z <= bound.z)
                    << "answer " << i << ", coefficient " << k << ": off by " << off.x << ", "
                    << off.y << ", " << off.z;
            }
            const glm::vec4 off = glm::abs(a.occlusion[i] - b.occlusion[i]);
            ASSERT_LE(std::max({off.x, off.y, off.z, off.w}), tolerance) << "answer " << i;
        }
    }
};

/// On a face, where either cell may answer: two steps of a float.
constexpr float kTwoSteps = 2.0f * 0x1p-23f;

TEST_P(KernelAgreement, EveryPathGivesOneAnswer) {
    const Answers expected = answers(Way::Plain, detail::scalar_kernels());
    for (const Way way : {Way::Plain, Way::Hints, Way::Sorted}) {
        const Answers scalar = answers(way, detail::scalar_kernels());
        EXPECT_TRUE(answers(way, detail::query_kernels()) == scalar) << "the twin's bits";
        expect_near(scalar, expected, kTwoSteps);
    }
}

TEST_P(KernelAgreement, WallsHideProbesWithTheTwinsBits) {
    if (volume.cells.empty()) return;
    test::add_random_walls(volume, 5);
    for (const bool is_compact : {false, true}) {
        if (is_compact) make_compact_probes(volume);
        const Answers expected = answers(Way::Plain, detail::scalar_kernels());
        EXPECT_TRUE(answers(Way::Plain, detail::query_kernels()) == expected) << "the twin's bits";
        EXPECT_TRUE(answers(Way::Sorted, detail::query_kernels()) == expected);
        for (size_t i = 0; i < positions.size(); i += 997) {
            const InterpolatedProbe probe =
                interpolate(volume.view(), locate(volume.view(), positions[i]));
            EXPECT_EQ(probe.irradiance, expected.irradiance[i]) << i;
        }
    }
}

TEST_P(KernelAgreement, CompactProbesGiveTheSameToHalfPrecision) {
    const Answers expected = answers(Way::Plain, detail::query_kernels());
    make_compact_probes(volume);
    for (const Way way : {Way::Plain, Way::Hints, Way::Sorted}) {
        const Answers compact = answers(way, detail::query_kernels());
        EXPECT_TRUE(answers(way, detail::scalar_kernels()) == compact) << "the twin's bits";
        expect_near(compact, expected, 0x1p-11f + kTwoSteps);
    }
}

TEST_P(KernelAgreement, EveryKindOfProcessorGivesTheSameBits) {
    positions.resize(std::min<size_t>(positions.size(), 100'000));
    const Answers expected = answers(Way::Plain, detail::scalar_kernels());
    for_each_target([&](const char* name) {
        EXPECT_TRUE(answers(Way::Plain, detail::query_kernels()) == expected) << name;
        RecordProperty(name, "checked");
    });
}

TEST_P(KernelAgreement, ASingleQueryGivesTheBitsOfTheBatch) {
    const ProbeVolumeView view = volume.view();
    std::vector<CellLocation> locations(positions.size());
    locate(view, positions, locations);
    for (size_t i = 0; i < positions.size(); ++i) {
        ASSERT_EQ(locate(view, positions[i]), locations[i]) << "position " << i;
    }
    // Of any part of the batch, too.
    const auto part = std::span(positions).subspan(positions.size() / 3, positions.size() / 2);
    std::vector<CellLocation> again(part.size());
    locate(view, part, again);
    EXPECT_TRUE(
        std::ranges::equal(again, std::span(locations).subspan(positions.size() / 3, part.size())));
}

TEST_P(KernelAgreement, ASeedGridChangesNoLight) {
    const Answers expected = answers(Way::Plain, detail::query_kernels());
    ASSERT_EQ(volume.seed_grid.empty(), volume.positions.empty());
    volume.seed_grid.clear();  // as in files of older versions
    make_seeds(volume);
    expect_near(answers(Way::Plain, detail::query_kernels()), expected, 2.0f * kTwoSteps);
}

INSTANTIATE_TEST_SUITE_P(All, KernelAgreement,
                         testing::Values(Case{"random", 0, 1'000}, Case{"random", 1, 10'000},
                                         Case{"random", 2, 10'000}, Case{"random", 3, 10'000},
                                         Case{"random", 4, 10'000}, Case{"line", 100, 20'000},
                                         Case{"plane", 300, 50'000}, Case{"sphere", 500, 50'000},
                                         Case{"turned_lattice", 729, 50'000},
                                         Case{"far", 500, 50'000}, Case{"random", 2'000, 750'000}),
                         [](const auto& instance) {
                             return instance.param.family + "_" +
                                    std::to_string(instance.param.probe_count);
                         });

}  // namespace
}  // namespace tetralight
