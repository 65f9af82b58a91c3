// SPDX-License-Identifier: Apache-2.0
// The batch query: every path through it gives the answers of single queries.
#include <gtest/gtest.h>

#include <cstring>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <thread>

#include <tetralight/base/error_text.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/detail/batch_queries.h>
#include "tests/support/probe_families.h"

namespace tetralight {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Occlusion and validity that differ from probe to probe.
ProbeVolume make_volume(std::vector<glm::dvec3> positions) {
    ProbeVolume volume = test::make_lit_volume(std::move(positions));
    std::mt19937 engine(1);
    std::uniform_real_distribution<float> share(0.0f, 1.0f);
    for (size_t i = 0; i < volume.positions.size(); ++i) {
        volume.occlusion.emplace_back(share(engine), share(engine), share(engine), share(engine));
        volume.validity.push_back(share(engine));
    }
    volume.info.ambient = test::linear_light({3, 2, 1});
    return volume;
}

/// Positions in and around the hull, on probes, and between them.
std::vector<glm::vec3> make_positions(const ProbeVolume& volume, size_t count) {
    std::mt19937_64 engine(2);
    std::uniform_real_distribution<float> coordinate(-1.5f, 1.5f);
    std::vector<glm::vec3> positions;
    while (positions.size() < count) {
        const Cell& cell = volume.cells[engine() % volume.cells.size()];
        const glm::vec3& a = volume.positions[cell.vertices[0]];
        const glm::vec3 b = cell.vertices[1] == kNoIndex ? a : volume.positions[cell.vertices[1]];
        const float size = volume.info.extent;
        const glm::vec3 any(coordinate(engine), coordinate(engine), coordinate(engine));
        for (const glm::vec3& local : {size * any, a, 0.5f * (a + b)}) {
            positions.emplace_back(glm::dvec3(local) + volume.info.world_origin);
        }
    }
    positions.resize(count);
    return positions;
}

/// The answers of a batch.
struct Answers {
    std::vector<IrradianceSh> irradiance;
    std::vector<glm::vec4> occlusion;

    explicit Answers(size_t count) : irradiance(count), occlusion(count) {}
};

void expect_near(const Answers& a, const Answers& b, float tolerance) {
    for (size_t i = 0; i < a.irradiance.size(); ++i) {
        for (int k = 0; k < kShCoefficientCount; ++k) {
            const glm::vec3& c = a.irradiance[i].coefficients[k];
            ASSERT_LE(glm::distance(c, b.irradiance[i].coefficients[k]),
                      tolerance * (1.0f + glm::length(c)))
                << "answer " << i;
        }
        ASSERT_LE(glm::distance(a.occlusion[i], b.occlusion[i]), tolerance) << "answer " << i;
    }
}

Answers single_queries(const ProbeVolumeView& volume, std::span<const glm::vec3> positions) {
    Answers answers(positions.size());
    for (size_t i = 0; i < positions.size(); ++i) {
        const InterpolatedProbe probe = interpolate(volume, locate(volume, positions[i]));
        answers.irradiance[i] = probe.irradiance;
        answers.occlusion[i] = probe.occlusion;
    }
    return answers;
}

class BatchFamilies : public testing::TestWithParam<size_t> {};

/// On a face either cell may answer, and the two answers differ by rounding; otherwise the bits are
/// those of single queries.
TEST_P(BatchFamilies, EveryKernelAnswersAsSingleQueriesDo) {
    const test::ProbeFamily family = test::probe_families()[GetParam()];
    SCOPED_TRACE(family.name);
    ProbeVolume volume = make_volume(family.make(1));
    const auto positions = make_positions(volume, 3000);
    for (const bool is_compact : {false, true}) {
        if (is_compact) make_compact_probes(volume);
        const Answers expected = single_queries(volume.view(), positions);
        for (const auto* kernels : {&detail::scalar_kernels(), &detail::query_kernels()}) {
            Answers answers(positions.size());
            const InterpolationBatch batch{positions,         {}, answers.irradiance,
                                           answers.occlusion, {}, {}};
            const auto report = detail::answer(volume.view(), batch, *kernels);
            EXPECT_GE(report.step_count, positions.size());
            expect_near(answers, expected, 1e-4f);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, BatchFamilies,
                         testing::Range<size_t>(0, test::probe_families().size()));

TEST(Batch, VectorCodeGivesTheBitsOfItsScalarTwin) {
    ProbeVolume volume = make_volume(test::random_positions(2000, 3));
    const auto positions = make_positions(volume, 20000);
    for (const bool is_compact : {false, true}) {
        if (is_compact) make_compact_probes(volume);
        std::vector<Answers> answers(2, Answers(positions.size()));
        std::vector<std::vector<uint32_t>> hints(2, std::vector(positions.size(), kNoIndex));
        for (size_t k = 0; k < 2; ++k) {
            const auto& kernels = k == 0 ? detail::scalar_kernels() : detail::query_kernels();
            const InterpolationBatch batch{
                positions, hints[k], answers[k].irradiance, answers[k].occlusion, {}, {}};
            static_cast<void>(detail::answer(volume.view(), batch, kernels));
        }
        EXPECT_EQ(hints[0], hints[1]);
        EXPECT_EQ(answers[0].irradiance, answers[1].irradiance);
        EXPECT_EQ(answers[0].occlusion, answers[1].occlusion);
    }
}

/// A batch over random positions, and what it must answer.
class BatchTest : public testing::Test {
  protected:
    ProbeVolume volume = make_volume(test::random_positions(300, 4));
    std::vector<glm::vec3> positions = make_positions(volume, 1023);
    Answers expected = single_queries(volume.view(), positions);
    Answers answers{positions.size()};

    InterpolationBatch batch() {
        return {positions, {}, answers.irradiance, answers.occlusion, {}, {}};
    }
};

TEST_F(BatchTest, EitherOutputMayBeLeftOut) {
    EXPECT_TRUE(interpolate(volume.view(), {positions, {}, answers.irradiance}));
    InterpolationBatch occlusion_only;
    occlusion_only.positions = positions;
    occlusion_only.occlusion = answers.occlusion;
    EXPECT_TRUE(interpolate(volume.view(), occlusion_only));
    expect_near(answers, expected, 1e-5f);
    EXPECT_TRUE(interpolate(volume.view(), InterpolationBatch{}));
}

TEST_F(BatchTest, NoOutputAtAllIsAnError) {
    EXPECT_FALSE(interpolate(volume.view(), {positions}));
}

TEST_F(BatchTest, AShortSpanIsAnErrorThatSaysBothLengths) {
    const auto expect_error = [&](const InterpolationBatch& wrong, const char* length) {
        const auto report = interpolate(volume.view(), wrong);
        ASSERT_FALSE(report);
        EXPECT_NE(error_text(report.error()).find(length), std::string::npos);
        EXPECT_NE(error_text(report.error()).find("1023"), std::string::npos);
    };
    InterpolationBatch wrong = batch();
    wrong.irradiance = std::span(answers.irradiance).first(1000);
    expect_error(wrong, "1000");
    wrong = batch();
    wrong.occlusion = std::span(answers.occlusion).first(1022);
    expect_error(wrong, "1022");
    wrong = batch();
    std::vector<uint32_t> hints(7);
    wrong.hints = hints;
    expect_error(wrong, " 7 ");
    wrong = batch();
    std::vector<uint64_t> sort_memory(2 * 1023 - 1);
    wrong.sort_memory = sort_memory;
    expect_error(wrong, "1022");
}

TEST_F(BatchTest, HintsSaveTheWalk) {
    std::vector<uint32_t> hints(positions.size(), 123456789);
    InterpolationBatch with_hints = batch();
    with_hints.hints = hints;
    const auto first = interpolate(volume.view(), with_hints);
    expect_near(answers, expected, 1e-5f);
    const auto second = interpolate(volume.view(), with_hints);
    ASSERT_TRUE(first && second);
    EXPECT_GT(first->step_count, positions.size() * 3 / 2);
    EXPECT_LE(second->step_count, positions.size() + positions.size() / 50);
    expect_near(answers, expected, 1e-5f);
}

TEST_F(BatchTest, SortingChangesTheOrderOfTheWorkAndNoBitOfTheAnswers) {
    std::vector<uint64_t> sort_memory(2 * positions.size());
    InterpolationBatch sorted = batch();
    sorted.sort_memory = sort_memory;
    const auto report = interpolate(volume.view(), sorted);
    const auto sorted_irradiance = answers.irradiance;
    const auto unsorted_report = interpolate(volume.view(), batch());
    ASSERT_TRUE(report && unsorted_report);
    EXPECT_EQ(report->step_count, unsorted_report->step_count);
    EXPECT_EQ(answers.irradiance, sorted_irradiance);
    expect_near(answers, expected, 1e-5f);
}

TEST_F(BatchTest, WalksAreShortWhereQueriesAreFarApart) {
    // From one end of the volume to the other at every query: from each to the next it is some
    // n^(1/3) cells, from a seed a few.
    const ProbeVolume large = test::make_lit_volume(test::random_positions(20'000, 1));
    std::vector<glm::vec3> far_apart;
    for (size_t i = 0; i < 1000; ++i) {
        const glm::vec3& local = large.positions[i % 2 ? i : large.positions.size() - 1 - i];
        far_apart.emplace_back(glm::dvec3(local) + large.info.world_origin);
    }
    answers.irradiance.resize(far_apart.size());
    const InterpolationBatch batch{far_apart, {}, answers.irradiance};
    const auto report = interpolate(large.view(), batch);
    ASSERT_TRUE(report);
    EXPECT_LT(report->step_count, 3 * far_apart.size());
}

TEST_F(BatchTest, PositionsThatAreNotFiniteAreAmbientAndCounted) {
    positions[0].x = kNan;
    positions[500].z = std::numeric_limits<float>::infinity();
    std::vector<uint64_t> sort_memory(2 * positions.size());
    for (const bool is_sorted : {false, true}) {
        InterpolationBatch odd = batch();
        if (is_sorted) odd.sort_memory = sort_memory;
        const auto report = interpolate(volume.view(), odd);
        ASSERT_TRUE(report);
        EXPECT_EQ(report->not_finite_count, 2u);
        EXPECT_EQ(answers.irradiance[0], volume.info.ambient);
        EXPECT_EQ(answers.occlusion[500], glm::vec4(1.0f));
        EXPECT_LE(glm::distance(answers.occlusion[1], expected.occlusion[1]), 1e-5f);
    }
}

TEST_F(BatchTest, OutsidePolicyIsThatOfSingleQueries) {
    for (const OutsidePolicy policy : {OutsidePolicy::Clamp, OutsidePolicy::Ambient}) {
        InterpolationBatch outside = batch();
        outside.outside = {policy, 0.5f};
        ASSERT_TRUE(interpolate(volume.view(), outside));
        std::vector<CellLocation> locations(positions.size());
        locate(volume.view(), positions, locations, outside.outside);
        for (size_t i = 0; i < positions.size(); ++i) {
            ASSERT_EQ(interpolate(volume.view(), locations[i]).occlusion, answers.occlusion[i]);
            const auto location = locate(volume.view(), positions[i], kNoIndex, outside.outside);
            const auto light = interpolate(volume.view(), location);
            ASSERT_LE(glm::distance(answers.irradiance[i].coefficients[0],
                                    light.irradiance.coefficients[0]),
                      1e-4f);
            ASSERT_LE(glm::distance(answers.occlusion[i], light.occlusion), 1e-4f);
        }
    }
}

TEST_F(BatchTest, PackedAnswersAreWrittenIntoAnInstanceBuffer) {
    struct Instance {
        float world[16];
        PackedSh light;
        glm::vec4 occlusion;
        float rest[3];
    };

    Instance blank{};
    for (float& value : blank.world) value = 42.0f;
    for (float& value : blank.rest) value = 43.0f;
    std::vector<Instance> instances(positions.size(), blank);
    const auto bytes = std::as_writable_bytes(std::span(instances));
    InterpolationBatch packed;
    packed.positions = positions;
    packed.irradiance =
        strided(bytes.subspan(offsetof(Instance, light)), ShFormat::Packed, sizeof(Instance));
    packed.occlusion =
        strided_occlusion(bytes.subspan(offsetof(Instance, occlusion)), sizeof(Instance));
    ASSERT_TRUE(interpolate(volume.view(), packed));
    for (size_t i = 0; i < instances.size(); ++i) {
        const PackedSh light = pack_sh(expected.irradiance[i]);
        EXPECT_LE(glm::distance(instances[i].light.sha_g, light.sha_g), 1e-5f);
        EXPECT_LE(glm::distance(instances[i].light.shc, light.shc), 1e-5f);
        EXPECT_LE(glm::distance(instances[i].occlusion, expected.occlusion[i]), 1e-5f);
        EXPECT_EQ(std::memcmp(instances[i].world, blank.world, sizeof blank.world), 0);
        EXPECT_EQ(std::memcmp(instances[i].rest, blank.rest, sizeof blank.rest), 0);
    }
}

TEST_F(BatchTest, ArraysHoldOneValueOfAllAnswersAfterAnother) {
    std::vector<float> values(27 * positions.size());
    InterpolationBatch soa;
    soa.positions = positions;
    soa.irradiance = arrays(std::as_writable_bytes(std::span(values)), ShFormat::Coefficients);
    ASSERT_TRUE(interpolate(volume.view(), soa));
    for (size_t i = 0; i < positions.size(); ++i) {
        for (size_t k = 0; k < 27; ++k) {
            const float wanted =
                expected.irradiance[i].coefficients[k / 3][static_cast<int>(k % 3)];
            ASSERT_NEAR(values[k * positions.size() + i], wanted, 1e-4f);
        }
    }
}

TEST_F(BatchTest, HalvesAreTheNearestOnes) {
    std::vector<uint16_t> halves(27 * positions.size());
    InterpolationBatch half;
    half.positions = positions;
    half.irradiance = strided(std::as_writable_bytes(std::span(halves)), ShFormat::Half, 54);
    ASSERT_TRUE(interpolate(volume.view(), half));
    for (size_t i = 0; i < positions.size(); ++i) {
        for (size_t k = 0; k < 27; ++k) {
            const float wanted =
                expected.irradiance[i].coefficients[k / 3][static_cast<int>(k % 3)];
            ASSERT_NEAR(glm::unpackHalf1x16(halves[27 * i + k]), wanted,
                        0x1p-11f * std::abs(wanted) + 1e-4f);
        }
    }
}

TEST_F(BatchTest, RunsOnTheCallersThreads) {
    positions = make_positions(volume, 3 * kBatchTaskSize + 17);
    answers = Answers(positions.size());
    std::vector<uint64_t> sort_memory(2 * positions.size());
    InterpolationBatch big = batch();
    big.sort_memory = sort_memory;
    const auto on_threads = [](size_t count, auto&& task) {
        std::vector<std::jthread> threads;
        for (size_t i = 0; i < count; ++i) threads.emplace_back([&task, i] { task(i); });
    };
    const auto report = interpolate(volume.view(), big, on_threads);
    ASSERT_TRUE(report);
    EXPECT_GE(report->step_count, positions.size());
    expect_near(answers, single_queries(volume.view(), positions), 1e-5f);
}

TEST_F(BatchTest, BlendsAtKnownLocations) {
    std::vector<CellLocation> locations(positions.size());
    locate(volume.view(), positions, locations);
    ASSERT_TRUE(blend(volume.view(), locations, answers.irradiance, answers.occlusion));
    expect_near(answers, expected, 1e-5f);
    EXPECT_FALSE(blend(volume.view(), locations, std::span(answers.irradiance).first(3), {}));
}

TEST(Batch, WithoutLightOrProbesTheAnswerIsAmbient) {
    ProbeVolume empty;
    empty.info.ambient = test::linear_light({1, 2, 3});
    ProbeVolume unlit = test::make_lit_volume(test::random_positions(20, 5));
    unlit.irradiance.clear();
    unlit.info.ambient = empty.info.ambient;
    const std::vector<glm::vec3> positions(300, glm::vec3(0.1f));
    for (const ProbeVolume* volume : {&empty, &unlit}) {
        Answers answers(positions.size());
        const InterpolationBatch batch{positions,         {}, answers.irradiance,
                                       answers.occlusion, {}, {}};
        ASSERT_TRUE(interpolate(volume->view(), batch));
        EXPECT_EQ(answers.irradiance[299], empty.info.ambient);
        EXPECT_EQ(answers.occlusion[299], glm::vec4(1.0f));
    }
}

TEST(Batch, CorruptIndicesNeverReadOutOfRange) {
    ProbeVolume sound = make_volume(test::random_positions(30, 6));
    make_compact_probes(sound);
    const auto positions = make_positions(sound, 64);
    std::mt19937_64 engine(7);
    for (int trial = 0; trial < 1000; ++trial) {
        ProbeVolume volume = sound;
        Cell& cell = volume.cells[engine() % volume.cells.size()];
        const auto value = static_cast<uint32_t>(engine());
        (trial % 2 == 0 ? cell.vertices : cell.neighbors)[engine() % 4] = value;
        Answers answers(positions.size());
        const InterpolationBatch batch{positions,         {}, answers.irradiance,
                                       answers.occlusion, {}, {}};
        ASSERT_TRUE(interpolate(volume.view(), batch));
    }
}

}  // namespace
}  // namespace tetralight
