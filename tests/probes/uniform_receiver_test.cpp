// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/uniform_receiver.h>

#include <gtest/gtest.h>

#include <array>

namespace tetralight {
namespace {

TEST(UniformReceiver, IsAtEveryPositionOfABatch) {
    const std::array<glm::vec3, 3> positions{};
    InterpolationBatch batch{.positions = positions};
    UniformReceiver receiver;
    receiver.set({Walls::Ignore, 0b1001, 0.5f}, batch);
    EXPECT_EQ(batch.walls, Walls::Ignore);
    ASSERT_EQ(batch.rendering_layers.size(), 3u);
    ASSERT_EQ(batch.radii.size(), 3u);
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(batch.rendering_layers[i], 0b1001u);
        EXPECT_EQ(batch.radii[i], 0.5f);
    }
}

/// Batches without them are answered by vectors.
TEST(UniformReceiver, HasNoArraysOfDefaults) {
    const std::array<glm::vec3, 3> positions{};
    InterpolationBatch batch{.positions = positions};
    UniformReceiver receiver;
    receiver.set({Walls::Ignore, 0b1001, 0.5f}, batch);
    receiver.set({}, batch);
    EXPECT_EQ(batch.walls, Walls::HideProbes);
    EXPECT_TRUE(batch.rendering_layers.empty());
    EXPECT_TRUE(batch.radii.empty());
}

TEST(UniformReceiver, LeavesAWrongRadiusToTheChecksOfTheBatch) {
    const std::array<glm::vec3, 1> positions{};
    std::array<CellLocation, 1> locations;
    InterpolationBatch batch{.positions = positions, .locations = locations};
    UniformReceiver receiver;
    receiver.set({.radius = -1.0f}, batch);
    const Status status = check_batch(batch);
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().field, "radii[0]");
}

}  // namespace
}  // namespace tetralight
