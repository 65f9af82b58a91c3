// SPDX-License-Identifier: Apache-2.0
// Where the compiler has integers of 128 bits, the substitute is compared with them; elsewhere with
// the expected bits alone.
#include <tetralight/base/detail/portable_int128.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <random>

#include <tetralight/base/compiler.h>

namespace tetralight {
namespace {

using detail::PortableInt128;
using detail::PortableUint128;

constexpr uint64_t kAll = ~uint64_t{0};

TEST(PortableInt128, CarriesFromTheLowHalf) {
    EXPECT_EQ(PortableUint128(0, kAll) + PortableUint128(1), PortableUint128(1, 0));
    EXPECT_EQ(PortableUint128(kAll, kAll) + PortableUint128(1), PortableUint128(0));
    EXPECT_EQ(PortableUint128(1, 0) - PortableUint128(1), PortableUint128(0, kAll));
    EXPECT_EQ(PortableUint128(0) - PortableUint128(1), PortableUint128(kAll, kAll));
}

// (2^64 - 1)^2 = 2^128 - 2^65 + 1.
TEST(PortableInt128, MultipliesTheLargestHalves) {
    EXPECT_EQ(PortableUint128(kAll) * PortableUint128(kAll), PortableUint128(kAll - 1, 1));
}

TEST(PortableInt128, ShiftsAcrossTheHalves) {
    EXPECT_EQ(PortableUint128(3) << 63, PortableUint128(1, uint64_t{1} << 63));
    EXPECT_EQ(PortableUint128(3) << 64, PortableUint128(3, 0));
    EXPECT_EQ(PortableUint128(3, 0) >> 1, PortableUint128(1, uint64_t{1} << 63));
    EXPECT_EQ(PortableUint128(3, 5) >> 64, PortableUint128(3));
    EXPECT_EQ(PortableUint128(3, 5) >> 0, PortableUint128(3, 5));
}

TEST(PortableInt128, ExtendsTheSign) {
    constexpr int64_t kSmallest = std::numeric_limits<int64_t>::min();
    EXPECT_EQ(static_cast<PortableUint128>(PortableInt128(-1)), PortableUint128(kAll, kAll));
    // (-2^63)^2 = 2^126.
    EXPECT_EQ(PortableInt128(kSmallest) * kSmallest,
              PortableInt128(PortableUint128(uint64_t{1} << 62, 0)));
    EXPECT_LT(PortableInt128(kSmallest) * 2, PortableInt128(kSmallest));
    EXPECT_GT(PortableInt128(1), PortableInt128(-1));
    EXPECT_FALSE(PortableInt128(-1) < PortableInt128(-1));
}

#ifdef __SIZEOF_INT128__

using Random = std::mt19937_64;

/// Random bits, often with long runs of equal ones, where carries happen.
uint64_t random_half(Random& random) {
    const uint64_t bits = random();
    switch (random() % 4) {
        case 0:
            return bits >> (random() % 64);
        case 1:
            return ~(bits >> (random() % 64));
        case 2:
            return bits << (random() % 64);
        default:
            return bits;
    }
}

struct Pair {
    Uint128 exact;
    PortableUint128 portable;
};

Pair random_pair(Random& random) {
    const uint64_t high = random_half(random), low = random_half(random);
    return {Uint128{high} << 64 | low, PortableUint128(high, low)};
}

bool same(Uint128 exact, PortableUint128 portable) {
    return static_cast<uint64_t>(exact >> 64) == portable.high() &&
           static_cast<uint64_t>(exact) == static_cast<uint64_t>(portable);
}

TEST(PortableInt128, AgreesWithTheUnsignedTypeOfTheCompiler) {
    Random random(1);
    for (int i = 0; i < 200'000; ++i) {
        const Pair a = random_pair(random), b = random_pair(random);
        const int count = static_cast<int>(random() % 128);
        ASSERT_TRUE(same(a.exact + b.exact, a.portable + b.portable));
        ASSERT_TRUE(same(a.exact - b.exact, a.portable - b.portable));
        ASSERT_TRUE(same(a.exact * b.exact, a.portable * b.portable));
        ASSERT_TRUE(same(a.exact | b.exact, a.portable | b.portable));
        ASSERT_TRUE(same(a.exact << count, a.portable << count)) << count;
        ASSERT_TRUE(same(a.exact >> count, a.portable >> count)) << count;
    }
}

TEST(PortableInt128, AgreesWithTheSignedTypeOfTheCompiler) {
    Random random(2);
    for (int i = 0; i < 200'000; ++i) {
        const auto a = static_cast<int64_t>(random_half(random));
        const auto b = static_cast<int64_t>(random_half(random));
        const Int128 product = Int128{a} * b;
        const PortableInt128 portable = PortableInt128{a} * b;
        ASSERT_TRUE(same(static_cast<Uint128>(product), static_cast<PortableUint128>(portable)));
        const auto c = static_cast<int64_t>(random_half(random));
        ASSERT_EQ(product - c < product, portable - c < portable) << a << ' ' << b;
        ASSERT_EQ(product > Int128{c} * a, portable > PortableInt128{c} * a) << a << ' ' << b;
    }
}

#endif

}  // namespace
}  // namespace tetralight
