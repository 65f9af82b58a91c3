// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

// Integers of 128 bits for compilers without such a type: those for 32-bit processors and MSVC.
// They have the operators that this project uses, with the results of the built-in types.

namespace tetralight::detail {

/// An unsigned integer modulo 2^128.
class PortableUint128 {
  public:
    constexpr PortableUint128() = default;

    constexpr PortableUint128(uint64_t value) : low_(value) {}  // NOLINT: as built-in integers

    /// high · 2^64 + low.
    constexpr PortableUint128(uint64_t high, uint64_t low) : low_(low), high_(high) {}

    /// Modulo 2^64.
    explicit constexpr operator uint64_t() const { return low_; }

    [[nodiscard]] constexpr uint64_t high() const { return high_; }

    friend constexpr PortableUint128 operator+(PortableUint128 a, PortableUint128 b) {
        const uint64_t low = a.low_ + b.low_;
        return {a.high_ + b.high_ + (low < a.low_ ? 1u : 0u), low};
    }

    friend constexpr PortableUint128 operator-(PortableUint128 a, PortableUint128 b) {
        return {a.high_ - b.high_ - (a.low_ < b.low_ ? 1u : 0u), a.low_ - b.low_};
    }

    friend constexpr PortableUint128 operator*(PortableUint128 a, PortableUint128 b) {
        PortableUint128 product = product_of_halves(a.low_, b.low_);
        product.high_ += a.high_ * b.low_ + a.low_ * b.high_;
        return product;
    }

    friend constexpr PortableUint128 operator|(PortableUint128 a, PortableUint128 b) {
        return {a.high_ | b.high_, a.low_ | b.low_};
    }

    /// Precondition: 0 <= count < 128.
    friend constexpr PortableUint128 operator<<(PortableUint128 value, int count) {
        if (count == 0) return value;
        if (count >= 64) return {value.low_ << (count - 64), 0};
        return {value.high_ << count | value.low_ >> (64 - count), value.low_ << count};
    }

    /// Precondition: 0 <= count < 128.
    friend constexpr PortableUint128 operator>>(PortableUint128 value, int count) {
        if (count == 0) return value;
        if (count >= 64) return {0, value.high_ >> (count - 64)};
        return {value.high_ >> count, value.low_ >> count | value.high_ << (64 - count)};
    }

    constexpr PortableUint128& operator-=(PortableUint128 b) { return *this = *this - b; }

    friend constexpr bool operator==(PortableUint128 a, PortableUint128 b) = default;

  private:
    /// a · b, from four products of 32 bits.
    static constexpr PortableUint128 product_of_halves(uint64_t a, uint64_t b) {
        constexpr uint64_t kLow = 0xffffffffu;
        const uint64_t low = (a & kLow) * (b & kLow);
        const uint64_t first = (a >> 32) * (b & kLow) + (low >> 32);
        const uint64_t second = (a & kLow) * (b >> 32) + (first & kLow);
        const uint64_t high = (a >> 32) * (b >> 32) + (first >> 32) + (second >> 32);
        return {high, second << 32 | (low & kLow)};
    }

    uint64_t low_ = 0;
    uint64_t high_ = 0;
};

/// A signed integer in two's complement. Results that do not fit are taken modulo 2^128.
class PortableInt128 {
  public:
    constexpr PortableInt128() = default;

    constexpr PortableInt128(int64_t value)  // NOLINT: as built-in integers
        : bits_(value < 0 ? ~uint64_t{0} : 0, static_cast<uint64_t>(value)) {}

    explicit constexpr PortableInt128(PortableUint128 bits) : bits_(bits) {}

    explicit constexpr operator PortableUint128() const { return bits_; }

    friend constexpr PortableInt128 operator+(PortableInt128 a, PortableInt128 b) {
        return PortableInt128(a.bits_ + b.bits_);
    }

    friend constexpr PortableInt128 operator-(PortableInt128 a, PortableInt128 b) {
        return PortableInt128(a.bits_ - b.bits_);
    }

    friend constexpr PortableInt128 operator*(PortableInt128 a, PortableInt128 b) {
        return PortableInt128(a.bits_ * b.bits_);
    }

    friend constexpr bool operator==(PortableInt128 a, PortableInt128 b) = default;

    friend constexpr bool operator<(PortableInt128 a, PortableInt128 b) {
        return a.biased().high() != b.biased().high()
                   ? a.biased().high() < b.biased().high()
                   : static_cast<uint64_t>(a.bits_) < static_cast<uint64_t>(b.bits_);
    }

    friend constexpr bool operator>(PortableInt128 a, PortableInt128 b) { return b < a; }

  private:
    /// The value + 2^127, which is not negative.
    [[nodiscard]] constexpr PortableUint128 biased() const {
        return bits_ + PortableUint128(uint64_t{1} << 63, 0);
    }

    PortableUint128 bits_;
};

}  // namespace tetralight::detail
