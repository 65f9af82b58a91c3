// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/delaunay/detail/big_integer.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tetralight::detail {

BigInteger BigInteger::from_double(double value, int unit) {
    BigInteger result;
    if (value == 0.0) return result;
    int exponent = 0;
    auto mantissa = static_cast<uint64_t>(std::ldexp(std::frexp(std::abs(value), &exponent), 53));
    int shift = exponent - 53 - unit;
    if (shift < 0) mantissa >>= -shift;  // of bits that are 0
    shift = std::max(shift, 0);
    const int first = shift / 32;
    result.size_ = first + 3;
    std::fill_n(result.limbs_, first, 0u);
    const uint64_t low = mantissa << 32 >> 32 << shift % 32;
    const uint64_t high = (mantissa >> 32 << shift % 32) + (low >> 32);
    result.limbs_[first] = static_cast<uint32_t>(low);
    result.limbs_[first + 1] = static_cast<uint32_t>(high);
    result.limbs_[first + 2] = static_cast<uint32_t>(high >> 32);
    result.is_negative_ = value < 0.0;
    result.drop_leading_zeros();
    return result;
}

BigInteger::BigInteger(const BigInteger& other)
    : size_(other.size_), is_negative_(other.is_negative_) {
    std::copy_n(other.limbs_, size_, limbs_);
}

BigInteger& BigInteger::operator=(const BigInteger& other) {
    if (this == &other) return *this;
    size_ = other.size_;
    is_negative_ = other.is_negative_;
    std::copy_n(other.limbs_, size_, limbs_);
    return *this;
}

int BigInteger::sign() const {
    if (size_ == 0) return 0;
    return is_negative_ ? -1 : 1;
}

void BigInteger::drop_leading_zeros() {
    while (size_ > 0 && limbs_[size_ - 1] == 0) --size_;
    if (size_ == 0) is_negative_ = false;
}

bool BigInteger::is_smaller(const BigInteger& a, const BigInteger& b) {
    if (a.size_ != b.size_) return a.size_ < b.size_;
    for (int i = a.size_ - 1; i >= 0; --i) {
        if (a.limbs_[i] != b.limbs_[i]) return a.limbs_[i] < b.limbs_[i];
    }
    return false;
}

/// With the sign of `a`.
BigInteger BigInteger::sum_of_magnitudes(const BigInteger& a, const BigInteger& b) {
    const BigInteger& longer = a.size_ >= b.size_ ? a : b;
    const BigInteger& shorter = a.size_ >= b.size_ ? b : a;
    BigInteger sum;
    uint64_t carry = 0;
    for (int i = 0; i < longer.size_; ++i) {
        carry += longer.limbs_[i];
        if (i < shorter.size_) carry += shorter.limbs_[i];
        sum.limbs_[i] = static_cast<uint32_t>(carry);
        carry >>= 32;
    }
    sum.size_ = longer.size_;
    if (carry != 0) sum.limbs_[sum.size_++] = static_cast<uint32_t>(carry);
    sum.is_negative_ = a.is_negative_;
    return sum;
}

/// With the sign of `a`. Precondition: the magnitude of `b` is not larger.
BigInteger BigInteger::difference_of_magnitudes(const BigInteger& a, const BigInteger& b) {
    BigInteger difference;
    difference.size_ = a.size_;
    int64_t borrow = 0;
    for (int i = 0; i < a.size_; ++i) {
        borrow += a.limbs_[i];
        if (i < b.size_) borrow -= b.limbs_[i];
        difference.limbs_[i] = static_cast<uint32_t>(borrow);
        borrow >>= 32;
    }
    difference.is_negative_ = a.is_negative_;
    difference.drop_leading_zeros();
    return difference;
}

BigInteger operator+(const BigInteger& a, const BigInteger& b) {
    if (a.size_ == 0) return b;
    if (a.is_negative_ == b.is_negative_) return BigInteger::sum_of_magnitudes(a, b);
    return BigInteger::is_smaller(a, b) ? BigInteger::difference_of_magnitudes(b, a)
                                        : BigInteger::difference_of_magnitudes(a, b);
}

BigInteger operator-(const BigInteger& a, const BigInteger& b) {
    BigInteger negative = b;
    negative.is_negative_ = b.size_ > 0 && !b.is_negative_;
    return a + negative;
}

BigInteger operator*(const BigInteger& a, const BigInteger& b) {
    BigInteger product;
    if (a.size_ == 0 || b.size_ == 0) return product;
    product.size_ = a.size_ + b.size_;
    std::fill_n(product.limbs_, product.size_, 0u);
    for (int i = 0; i < a.size_; ++i) {
        uint64_t carry = 0;
        for (int j = 0; j < b.size_; ++j) {
            carry += uint64_t{a.limbs_[i]} * b.limbs_[j] + product.limbs_[i + j];
            product.limbs_[i + j] = static_cast<uint32_t>(carry);
            carry >>= 32;
        }
        product.limbs_[i + b.size_] = static_cast<uint32_t>(carry);
    }
    product.is_negative_ = a.is_negative_ != b.is_negative_;
    product.drop_leading_zeros();
    return product;
}

}  // namespace tetralight::detail
