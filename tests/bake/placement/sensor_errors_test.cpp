// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/sensor_errors.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/bake/placement/grid_support.h"
#include "tests/support/rooms.h"

namespace tetralight {
namespace {

/// Two rooms beside each other with even radiance 1 and 3 in them, and a probe in each of their
/// corners, 0.5 m off the walls. Cells go from room to room.
class SensorErrors : public testing::Test {
  protected:
    SensorErrors() {
        std::vector<glm::dvec3> positions;
        for (const size_t room : {0, 1}) test::add_probes_of_room(room, 2, 0.5, positions);
        for (const glm::dvec3& position : positions) probes_.push_back(pool_.add(position));
    }

    SensorError error_at(const glm::dvec3& place, const ErrorScale& scale) {
        const uint32_t sensor = pool_.add(place);
        EXPECT_TRUE(pool_.bake({}));
        const ProbeVolume volume = volume_of(pool_, probes_);
        const std::vector<bool> is_to_cover(pool_.size(), is_to_cover_);
        const SensorView view{pool_, sights_, scale, is_to_cover};
        return sensor_errors(volume, probes_, std::span(&sensor, 1), view, 1).front();
    }

    const Scene scene_ = test::row_of_rooms({1.0f, 3.0f});
    const Result<TraceScene> traced_ = TraceScene::make_static(scene_);
    LightPool pool_{scene_, {}};
    Sights sights_{*traced_, pool_};
    std::vector<uint32_t> probes_;
    bool is_to_cover_ = true;
};

/// Of light by 128 samples, squared.
constexpr double kNoise = 2e-3;

const ErrorScale kScale(ErrorKind::Absolute, std::numbers::pi);

TEST_F(SensorErrors, CornersBehindAWallHaveNoWeight) {
    // The last probes of the room are at x = 1.5, the first of the next at 2.7: seen ones have the
    // weight 2/3 at 1.9.
    const SensorError error = error_at({1.9, 1.1, 0.9}, kScale);
    EXPECT_NEAR(error.square, 0.0, kNoise);
    EXPECT_TRUE(error.is_covered);
}

TEST_F(SensorErrors, OutsideOfTheTetrahedraNothingIsCovered) {
    const SensorError error = error_at({0.2, 1.1, 0.9}, kScale);
    EXPECT_NEAR(error.square, 0.0, kNoise);
    EXPECT_FALSE(error.is_covered);
    EXPECT_GT(error.cost(), 9.0);
}

TEST_F(SensorErrors, WhereNothingHasToBeCoveredItIsNoCost) {
    is_to_cover_ = false;
    EXPECT_LT(error_at({0.2, 1.1, 0.9}, kScale).cost(), 1e-3);  // noise
}

TEST_F(SensorErrors, WithoutAProbeInSightTheyAreThoseOfAllCorners) {
    probes_.resize(8);  // the first room's
    const SensorError error = error_at({2.5, 1.1, 0.9}, kScale);
    // Irradiance π where 3 π is true, relative to π.
    EXPECT_NEAR(error.square, 4.0, 100.0 * kNoise);
    EXPECT_FALSE(error.is_covered);
}

TEST_F(SensorErrors, MeansAreRootsOfMeanSquares) {
    const std::vector<SensorError> errors{{0, 1.0f, true}, {0, 4.0f, true}, {0, 0.0f, false}};
    EXPECT_NEAR(mean_error(errors), std::sqrt(5.0 / 3.0), 1e-6);
    EXPECT_EQ(mean_error({}), 0.0);
}

}  // namespace
}  // namespace tetralight
