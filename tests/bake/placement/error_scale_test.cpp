// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/error_scale.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tetralight {
namespace {

/// This irradiance for every normal.
IrradianceSh even(double irradiance) {
    const auto radiance = static_cast<float>(irradiance / std::numbers::pi);
    return irradiance_from_radiance(constant_radiance(glm::vec3(radiance)));
}

double square_of(ErrorKind kind, double mean, double truth) {
    return ErrorScale(kind, mean).square(even(0.3), even(truth));
}

TEST(ErrorScale, AbsoluteErrorsAreRelativeToTheMean) {
    EXPECT_NEAR(square_of(ErrorKind::Absolute, 2.0, 5.0), 0.15 * 0.15, 1e-6);
    EXPECT_NEAR(square_of(ErrorKind::Absolute, 2.0, 0.0), 0.15 * 0.15, 1e-6);
}

TEST(ErrorScale, RelativeErrorsAreRelativeToThePlace) {
    EXPECT_NEAR(square_of(ErrorKind::Relative, 2.0, 5.0), 0.06 * 0.06, 1e-6);
    EXPECT_NEAR(square_of(ErrorKind::Relative, 2.0, 0.5), 0.6 * 0.6, 1e-6);
}

TEST(ErrorScale, MixedErrorsAreBetweenBoth) {
    // 0.15 of the mean and 0.06 of the place: their geometric mean.
    EXPECT_NEAR(square_of(ErrorKind::Mixed, 2.0, 5.0), 0.15 * 0.06, 1e-6);
}

TEST(ErrorScale, MixedErrorsAreTwiceTheDifferencesOfSquareRoots) {
    // d(2 √E) = dE / √E: a small error counts the same in the dark and in bright light if the
    // square roots differ by the same.
    for (const double truth : {0.5, 2.0, 8.0}) {
        const double root = std::sqrt(truth) + 1e-3;
        const double square =
            ErrorScale(ErrorKind::Mixed, 2.0).square(even(root * root - truth), even(truth));
        EXPECT_NEAR(square, 4.0 * 1e-6 / 2.0, 4e-9) << truth;
    }
}

TEST(ErrorScale, TheDarkestPlacesCountAsATwentiethOfTheMean) {
    for (const ErrorKind kind : {ErrorKind::Relative, ErrorKind::Mixed}) {
        EXPECT_NEAR(square_of(kind, 2.0, 0.0), square_of(kind, 2.0, 0.1), 1e-5);
        EXPECT_LT(square_of(kind, 2.0, 0.11), 0.95 * square_of(kind, 2.0, 0.1));
    }
}

TEST(ErrorScale, InADarkSceneErrorsHaveNoWeight) {
    for (const ErrorKind kind : {ErrorKind::Absolute, ErrorKind::Relative, ErrorKind::Mixed}) {
        EXPECT_EQ(square_of(kind, 0.0, 1.0), 0.0);
    }
}

}  // namespace
}  // namespace tetralight
