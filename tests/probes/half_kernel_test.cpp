// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/detail/half_kernel.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include <tetralight/base/half.h>

#ifdef TETRALIGHT_HAS_HIGHWAY
#include <hwy/highway.h>
#endif

namespace tetralight {
namespace {

/// Of every size, among them denormal halves, ties and numbers that no half holds.
std::vector<float> make_numbers(size_t count) {
    std::mt19937_64 engine(5);
    std::uniform_real_distribution<float> value(-1.0f, 1.0f), exponent(-30.0f, 18.0f);
    std::vector<float> numbers;
    while (numbers.size() < count) {
        const float number = value(engine) * std::exp2(exponent(engine));
        numbers.push_back(number);
        numbers.push_back(std::ldexp(std::round(std::ldexp(number, 12)), -12));
    }
    numbers.resize(count);
    return numbers;
}

TEST(HalfKernel, GivesTheNearestHalves) {
    const std::vector<float> numbers = make_numbers(100'001);
    std::vector<uint16_t> halves(numbers.size());
    detail::write_halves(numbers, halves.data());
    for (size_t i = 0; i < numbers.size(); ++i) {
        ASSERT_EQ(halves[i], half_from_float(numbers[i])) << numbers[i];
    }
}

TEST(HalfKernel, WritesNothingBeyondItsCount) {
    const std::vector<float> numbers = make_numbers(64);
    for (size_t count = 0; count <= numbers.size(); ++count) {
        std::vector<uint16_t> halves(count + 16, 0x1234);
        detail::write_halves(std::span(numbers).first(count), halves.data());
        for (size_t i = 0; i < halves.size(); ++i) {
            ASSERT_EQ(halves[i], i < count ? half_from_float(numbers[i]) : 0x1234) << count;
        }
    }
}

#ifdef TETRALIGHT_HAS_HIGHWAY
TEST(HalfKernel, VectorCodeGivesTheBitsOfItsScalarTwin) {
    const std::vector<float> numbers = make_numbers(27 * 1000);
    std::vector<uint16_t> expected(numbers.size());
    detail::write_halves_scalar(numbers, expected.data());
    for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        std::vector<uint16_t> halves(numbers.size());
        for (size_t i = 0; i < numbers.size(); i += 27) {
            detail::write_halves_in_vectors(std::span(numbers).subspan(i, 27), &halves[i]);
        }
        EXPECT_EQ(halves, expected) << hwy::TargetName(target);
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}
#endif

}  // namespace
}  // namespace tetralight
