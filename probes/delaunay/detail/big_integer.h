// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace tetralight::detail {

/// An integer as large as predicates of any doubles need: 5 factors of 2100 bits. It lies on the
/// stack, 1.4 kB, and copies what it uses of them.
class BigInteger {
  public:
    BigInteger() = default;

    /// value / 2^unit. Precondition: finite, and an integer.
    [[nodiscard]] static BigInteger from_double(double value, int unit);

    BigInteger(const BigInteger& other);
    BigInteger& operator=(const BigInteger& other);

    /// −1, 0 or 1.
    [[nodiscard]] int sign() const;

    friend BigInteger operator+(const BigInteger& a, const BigInteger& b);
    friend BigInteger operator-(const BigInteger& a, const BigInteger& b);
    friend BigInteger operator*(const BigInteger& a, const BigInteger& b);

  private:
    static constexpr int kCapacity = 340;

    void drop_leading_zeros();
    static bool is_smaller(const BigInteger& a, const BigInteger& b);
    static BigInteger sum_of_magnitudes(const BigInteger& a, const BigInteger& b);
    static BigInteger difference_of_magnitudes(const BigInteger& a, const BigInteger& b);

    int size_ = 0;  // limbs in use; the last of them is not 0
    bool is_negative_ = false;
    uint32_t limbs_[kCapacity];  // of the magnitude, the lowest first
};

}  // namespace tetralight::detail
