// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <tetralight/base/compiler.h>

namespace tetralight::detail {

/// An integer of 64 · N bits in two's complement. Sums and differences have to fit.
template <int N>
struct WideInteger {
    uint64_t limbs[N];  ///< the lowest first

    [[nodiscard]] bool is_negative() const { return static_cast<int64_t>(limbs[N - 1]) < 0; }

    [[nodiscard]] int sign() const {
        uint64_t bits = 0;
        for (const uint64_t limb : limbs) bits |= limb;
        if (is_negative()) return -1;
        return bits != 0 ? 1 : 0;
    }
};

template <int N>
WideInteger<N> operator+(const WideInteger<N>& a, const WideInteger<N>& b) {
    WideInteger<N> sum;
    uint64_t carry = 0;
    for (int i = 0; i < N; ++i) {
        const Uint128 limb = Uint128{a.limbs[i]} + b.limbs[i] + carry;
        sum.limbs[i] = static_cast<uint64_t>(limb);
        carry = static_cast<uint64_t>(limb >> 64);
    }
    return sum;
}

template <int N>
WideInteger<N> operator-(const WideInteger<N>& a, const WideInteger<N>& b) {
    WideInteger<N> difference;
    uint64_t borrow = 0;
    for (int i = 0; i < N; ++i) {
        const Uint128 limb = Uint128{a.limbs[i]} - b.limbs[i] - borrow;
        difference.limbs[i] = static_cast<uint64_t>(limb);
        borrow = static_cast<uint64_t>(limb >> 64) & 1u;
    }
    return difference;
}

/// Subtracts `value` from the two highest limbs.
template <int N>
void subtract_from_top(WideInteger<N>& from, Uint128 value) {
    Uint128 top = Uint128{from.limbs[N - 1]} << 64 | from.limbs[N - 2];
    top -= value;
    from.limbs[N - 2] = static_cast<uint64_t>(top);
    from.limbs[N - 1] = static_cast<uint64_t>(top >> 64);
}

/// a · b. The product of the bits, less what they count too much where a number is negative.
inline WideInteger<3> multiply(int64_t a, Int128 b) {
    const auto bits_of_a = static_cast<uint64_t>(a);
    const auto bits_of_b = static_cast<Uint128>(b);
    const Uint128 low = Uint128{bits_of_a} * static_cast<uint64_t>(bits_of_b);
    const Uint128 high = Uint128{bits_of_a} * static_cast<uint64_t>(bits_of_b >> 64);
    const Uint128 middle = (low >> 64) + static_cast<uint64_t>(high);
    WideInteger<3> product{
        {static_cast<uint64_t>(low), static_cast<uint64_t>(middle),
         static_cast<uint64_t>(high >> 64) + static_cast<uint64_t>(middle >> 64)}};
    if (a < 0) subtract_from_top(product, bits_of_b);
    if (b < 0) product.limbs[2] -= bits_of_a;
    return product;
}

/// a · b.
inline WideInteger<5> multiply(Uint128 a, const WideInteger<3>& b) {
    const uint64_t limbs_of_a[] = {static_cast<uint64_t>(a), static_cast<uint64_t>(a >> 64)};
    WideInteger<5> product{};
    for (int i = 0; i < 2; ++i) {
        uint64_t carry = 0;
        for (int j = 0; j < 3; ++j) {
            const Uint128 limb = Uint128{limbs_of_a[i]} * b.limbs[j] + product.limbs[i + j] + carry;
            product.limbs[i + j] = static_cast<uint64_t>(limb);
            carry = static_cast<uint64_t>(limb >> 64);
        }
        product.limbs[i + 3] = carry;
    }
    if (b.is_negative()) subtract_from_top(product, a);
    return product;
}

}  // namespace tetralight::detail
