// SPDX-License-Identifier: Apache-2.0
// What is lit, position by position, in batches.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include <tetralight/probes/detail/batch_queries.h>
#include <tetralight/probes/interpolate.h>
#include "tests/support/random_probes.h"
#include "tests/support/random_walls.h"

namespace tetralight {
namespace {

/// More positions than a block of queries, in random order.
class ReceiverBatch : public testing::Test {
  protected:
    ProbeVolume volume = test::make_lit_volume(test::random_positions(300, 1));
    std::vector<glm::vec3> positions, normals;
    std::vector<uint32_t> layers;
    std::vector<float> radii;
    std::vector<IrradianceSh> light;
    std::vector<CellLocation> locations;
    InterpolationBatch batch;

    void SetUp() override {
        test::add_random_walls(volume, 2);
        std::mt19937_64 engine(3);
        for (size_t i = 0; i < volume.positions.size(); ++i) {
            volume.rendering_layers.push_back(static_cast<uint32_t>(engine() % 3 + 1));
        }
        std::uniform_real_distribution<float> radius(0.0f, 0.5f);
        for (const glm::dvec3& position : test::random_positions(1500, 4, 1.5)) {
            positions.emplace_back(position);
            normals.push_back(test::random_direction(engine));
            layers.push_back(static_cast<uint32_t>(engine() % 4));
            radii.push_back(engine() % 4 == 0 ? 0.0f : radius(engine));
        }
        light.resize(positions.size());
        locations.resize(positions.size());
        batch.positions = positions;
        batch.irradiance = light;
        batch.locations = locations;
    }

    /// Holds that the batch gives the bits of single queries, with all kernels.
    void expect_singles() {
        for (const auto* kernels : {&detail::scalar_kernels(), &detail::query_kernels()}) {
            static_cast<void>(detail::answer(volume.view(), batch, *kernels));
            for (size_t i = 0; i < positions.size(); ++i) expect_single(i);
        }
    }

  private:
    void expect_single(size_t i) const {
        const ProbeVolumeView view = volume.view();
        const uint32_t hint = kNoIndex;
        glm::vec3 position = positions[i];
        CellLocation location = locate(view, position, hint);
        if (!batch.normals.empty()) {
            position = push_off_surface(view, position, normals[i], location, batch.normal_offset);
            location = locate(view, position, location.cell);
        }
        Receiver receiver{batch.walls};
        if (!batch.rendering_layers.empty()) receiver.rendering_layers = layers[i];
        if (!batch.radii.empty()) receiver.radius = radii[i];
        ASSERT_EQ(locations[i], location) << i;
        const IrradianceSh expected = interpolate(view, location, receiver).irradiance;
        for (int k = 0; k < kShCoefficientCount; ++k) {
            const glm::vec3 off = light[i].coefficients[k] - expected.coefficients[k];
            ASSERT_NEAR(glm::length(off), 0.0f, 1e-5f) << i;
        }
    }
};

TEST_F(ReceiverBatch, HasRenderingLayersForEachPosition) {
    batch.rendering_layers = layers;
    expect_singles();
}

TEST_F(ReceiverBatch, HasARadiusForEachPosition) {
    batch.radii = radii;
    expect_singles();
    batch.walls = Walls::Ignore;
    expect_singles();
}

TEST_F(ReceiverBatch, HasANormalForEachPosition) {
    batch.normals = normals;
    expect_singles();
    batch.normal_offset = 0.0f;
    expect_singles();
}

TEST_F(ReceiverBatch, HasAllOfThem) {
    batch.rendering_layers = layers;
    batch.radii = radii;
    batch.normals = normals;
    expect_singles();
}

TEST_F(ReceiverBatch, SortsPositionsWithTheirReceivers) {
    std::vector<uint64_t> memory(2 * positions.size());
    batch.sort_memory = memory;
    batch.rendering_layers = layers;
    batch.radii = radii;
    expect_singles();
}

TEST_F(ReceiverBatch, WritesTheCellsOfPushedPositionsAsHints) {
    std::vector<uint32_t> hints(positions.size(), kNoIndex);
    batch.hints = hints;
    batch.normals = normals;
    ASSERT_TRUE(interpolate(volume.view(), batch));
    for (size_t i = 0; i < positions.size(); ++i) EXPECT_EQ(hints[i], locations[i].cell);
}

TEST_F(ReceiverBatch, IsTheSameInParallelParts) {
    batch.rendering_layers = layers;
    batch.radii = radii;
    batch.normals = normals;
    for (int i = 0; i < 12; ++i) {  // more than a task
        positions.insert(positions.end(), positions.begin(), positions.begin() + 1500);
        normals.insert(normals.end(), normals.begin(), normals.begin() + 1500);
        layers.insert(layers.end(), layers.begin(), layers.begin() + 1500);
        radii.insert(radii.end(), radii.begin(), radii.begin() + 1500);
    }
    ASSERT_GT(positions.size(), kBatchTaskSize);
    std::vector<IrradianceSh> whole(positions.size()), parts(positions.size());
    batch = {};
    batch.positions = positions;
    batch.rendering_layers = layers;
    batch.radii = radii;
    batch.normals = normals;
    batch.irradiance = whole;
    const auto report = interpolate(volume.view(), batch);
    ASSERT_TRUE(report);
    batch.irradiance = parts;
    const auto parallel = interpolate(volume.view(), batch, [](size_t count, auto&& task) {
        for (size_t i = count; i-- > 0;) task(i);
    });
    ASSERT_TRUE(parallel);
    EXPECT_EQ(*report, *parallel);
    EXPECT_EQ(whole, parts);
}

TEST_F(ReceiverBatch, CountsPositionsAndNormalsThatAreNotFiniteOnce) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    positions[3].x = kNan;
    normals[700].y = kNan;
    batch.normals = normals;
    const auto report = interpolate(volume.view(), batch);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->not_finite_count, 2u);
    EXPECT_EQ(light[3], volume.info.ambient);
    EXPECT_EQ(light[700], volume.info.ambient);
}

TEST_F(ReceiverBatch, RefusesWrongLengthsAndNumbers) {
    const auto field = [&](const InterpolationBatch& wrong) {
        const auto report = interpolate(volume.view(), wrong);
        return report ? std::string() : report.error().field;
    };
    InterpolationBatch wrong = batch;
    wrong.normals = std::span(normals).first(7);
    EXPECT_EQ(field(wrong), "normals");
    wrong = batch;
    wrong.rendering_layers = std::span(layers).first(7);
    EXPECT_EQ(field(wrong), "rendering_layers");
    wrong = batch;
    radii[5] = -1.0f;
    wrong.radii = radii;
    EXPECT_EQ(field(wrong), "radii[5]");
    wrong = batch;
    wrong.normal_offset = std::numeric_limits<float>::infinity();
    EXPECT_EQ(field(wrong), "normal_offset");
}

}  // namespace
}  // namespace tetralight
