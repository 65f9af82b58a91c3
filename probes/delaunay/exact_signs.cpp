// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/delaunay/exact_signs.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include <tetralight/base/compiler.h>
#include <tetralight/probes/delaunay/detail/big_integer.h>
#include <tetralight/probes/delaunay/detail/wide_integer.h>

namespace tetralight {
namespace {

using detail::BigInteger;
using detail::multiply;
using detail::WideInteger;

template <class Position, size_t N>
using Positions = std::array<const Position*, N>;

/// Differences of positions and the last of them, in units of 2^unit.
template <class Integer, size_t N>
using Rows = std::array<std::array<Integer, 3>, N>;

template <class Position, size_t N>
ExponentRange exponent_range(const Positions<Position, N>& positions) {
    ExponentRange range;
    for (const Position* position : positions) {
        for (int axis = 0; axis < Position::length(); ++axis) range.include((*position)[axis]);
    }
    return range;
}

/// True if differences have 62 bits at most, and a double holds the unit.
bool is_narrow(const ExponentRange& range) {
    return range.highest - range.lowest <= 61 && range.lowest > -1000 && range.lowest < 1000;
}

template <class Position, size_t N>
Rows<int64_t, N - 1> narrow_rows(const Positions<Position, N>& positions, int unit) {
    const auto per_unit = std::bit_cast<double>(static_cast<uint64_t>(1023 - unit) << 52);
    Rows<int64_t, N - 1> rows{};
    for (int axis = 0; axis < Position::length(); ++axis) {
        const auto origin = static_cast<int64_t>((*positions[N - 1])[axis] * per_unit);
        for (size_t i = 0; i + 1 < N; ++i) {
            rows[i][axis] = static_cast<int64_t>((*positions[i])[axis] * per_unit) - origin;
        }
    }
    return rows;
}

template <class Position, size_t N>
Rows<BigInteger, N - 1> wide_rows(const Positions<Position, N>& positions, int unit) {
    Rows<BigInteger, N - 1> rows;
    for (int axis = 0; axis < Position::length(); ++axis) {
        const BigInteger origin = BigInteger::from_double((*positions[N - 1])[axis], unit);
        for (size_t i = 0; i + 1 < N; ++i) {
            rows[i][axis] = BigInteger::from_double((*positions[i])[axis], unit) - origin;
        }
    }
    return rows;
}

// Products of the integers of `narrow_rows`, 62 bits, and of what is made of them. Those of
// BigInteger are operators.

Int128 product(int64_t a, int64_t b) {
    return Int128{a} * b;
}

WideInteger<3> product(int64_t a, Int128 b) {
    return multiply(a, b);
}

/// `a`: a sum of squares.
WideInteger<5> product(Int128 a, const WideInteger<3>& b) {
    return multiply(static_cast<Uint128>(a), b);
}

WideInteger<5> product(Int128 a, Int128 b) {
    return multiply(static_cast<Uint128>(a), multiply(int64_t{1}, b));
}

BigInteger product(const BigInteger& a, const BigInteger& b) {
    return a * b;
}

int sign_of(Int128 value) {
    return value > 0 ? 1 : (value < 0 ? -1 : 0);
}

template <class Integer>
int sign_of(const Integer& value) {
    return value.sign();
}

/// The determinant of two columns of two rows.
template <class Integer>
auto minor_of(const std::array<Integer, 3>& a, const std::array<Integer, 3>& b, int i, int j) {
    return product(a[i], b[j]) - product(b[i], a[j]);
}

template <class Integer>
int orientation_sign(const Rows<Integer, 3>& rows) {
    const auto& [b, c, d] = rows;
    return sign_of(product(b[0], minor_of(c, d, 1, 2)) + product(b[1], minor_of(c, d, 2, 0)) +
                   product(b[2], minor_of(c, d, 0, 1)));
}

template <class Integer>
auto squared_length(const std::array<Integer, 3>& row) {
    return product(row[0], row[0]) + product(row[1], row[1]) + product(row[2], row[2]);
}

/// The determinant of three rows, by the minors of x and y of their pairs.
template <class Integer, class Minor>
auto volume_of(const Integer& a_z, const Minor& bc, const Integer& b_z, const Minor& ca,
               const Integer& c_z, const Minor& ab) {
    return product(a_z, bc) + product(b_z, ca) + product(c_z, ab);
}

template <class Integer>
int in_sphere_sign(const Rows<Integer, 4>& rows) {
    const auto& [a, b, c, d] = rows;
    const auto ab = minor_of(a, b, 0, 1), bc = minor_of(b, c, 0, 1), cd = minor_of(c, d, 0, 1);
    const auto da = minor_of(d, a, 0, 1), ca = minor_of(c, a, 0, 1), bd = minor_of(b, d, 0, 1);
    const auto ac = minor_of(a, c, 0, 1), db = minor_of(d, b, 0, 1);
    const auto abc = volume_of(a[2], bc, b[2], ca, c[2], ab);
    const auto bcd = volume_of(b[2], cd, c[2], db, d[2], bc);
    const auto cda = volume_of(c[2], da, d[2], ac, a[2], cd);
    const auto dab = volume_of(d[2], ab, a[2], bd, b[2], da);
    return sign_of((product(squared_length(a), bcd) - product(squared_length(b), cda)) +
                   (product(squared_length(c), dab) - product(squared_length(d), abc)));
}

template <class Integer>
int in_circle_sign(const Rows<Integer, 3>& rows) {
    const auto& [a, b, c] = rows;
    return sign_of(product(squared_length(a), minor_of(b, c, 0, 1)) +
                   product(squared_length(b), minor_of(c, a, 0, 1)) +
                   product(squared_length(c), minor_of(a, b, 0, 1)));
}

/// Calls `sign_of_rows` with the rows of positions, in integers that hold them.
template <class Position, size_t N, class SignOfRows>
int exact_sign(const Positions<Position, N>& positions, const SignOfRows& sign_of_rows) {
    const ExponentRange range = exponent_range(positions);
    return is_narrow(range) ? sign_of_rows(narrow_rows(positions, range.lowest))
                            : sign_of_rows(wide_rows(positions, range.lowest));
}

/// Rows of differences with `origin`, in units.
template <size_t N>
Rows<int64_t, N> small_rows(const std::array<const glm::dvec3*, N>& positions,
                            const glm::dvec3& origin, double per_unit) {
    Rows<int64_t, N> rows;
    for (size_t i = 0; i < N; ++i) {
        const glm::dvec3 difference = (*positions[i] - origin) * per_unit;
        rows[i] = {static_cast<int64_t>(difference.x), static_cast<int64_t>(difference.y),
                   static_cast<int64_t>(difference.z)};
    }
    return rows;
}

}  // namespace

void ExponentRange::include(double coordinate) {
    const auto bits = std::bit_cast<uint64_t>(coordinate);
    const int exponent = static_cast<int>(bits >> 52 & 0x7ffu);
    const uint64_t fraction = bits & 0xf'ffff'ffff'ffffu;
    const uint64_t mantissa = exponent == 0 ? fraction : fraction | uint64_t{1} << 52;
    if (mantissa == 0) return;
    lowest = std::min(lowest, std::max(exponent, 1) - 1075 + std::countr_zero(mantissa));
    highest = std::max(highest, exponent - 1022);
}

int small_orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                      const glm::dvec3& d, double per_unit) {
    const auto [r, s, t] = small_rows<3>({&b, &c, &d}, a, per_unit);
    const auto minor = [](const auto& p, const auto& q, int i, int j) {
        return p[i] * q[j] - q[i] * p[j];
    };
    return sign_of(product(r[0], minor(s, t, 1, 2)) + product(r[1], minor(s, t, 2, 0)) +
                   product(r[2], minor(s, t, 0, 1)));
}

int small_in_sphere(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                    const glm::dvec3& d, const glm::dvec3& e, double per_unit) {
    const auto [p, q, r, s] = small_rows<4>({&a, &b, &c, &d}, e, per_unit);
    const auto minor = [](const auto& m, const auto& n) { return m[0] * n[1] - n[0] * m[1]; };
    const auto square = [](const auto& m) { return m[0] * m[0] + m[1] * m[1] + m[2] * m[2]; };
    const int64_t pq = minor(p, q), qr = minor(q, r), rs = minor(r, s);
    const int64_t sp = minor(s, p), pr = minor(p, r), qs = minor(q, s);
    const Int128 pqr = product(p[2], qr) - product(q[2], pr) + product(r[2], pq);
    const Int128 qrs = product(q[2], rs) - product(r[2], qs) + product(s[2], qr);
    const Int128 rsp = product(r[2], sp) + product(s[2], pr) + product(p[2], rs);
    const Int128 spq = product(s[2], pq) + product(p[2], qs) + product(q[2], sp);
    return sign_of((square(p) * qrs - square(q) * rsp) + (square(r) * spq - square(s) * pqr));
}

int exact_orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                      const glm::dvec3& d) {
    return exact_sign(Positions<glm::dvec3, 4>{&b, &c, &d, &a},
                      [](const auto& rows) { return orientation_sign(rows); });
}

int exact_in_sphere(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                    const glm::dvec3& d, const glm::dvec3& e) {
    return exact_sign(Positions<glm::dvec3, 5>{&a, &b, &c, &d, &e},
                      [](const auto& rows) { return in_sphere_sign(rows); });
}

int exact_orientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return exact_sign(Positions<glm::dvec2, 3>{&b, &c, &a},
                      [](const auto& rows) { return sign_of(minor_of(rows[0], rows[1], 0, 1)); });
}

int exact_in_circle(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c,
                    const glm::dvec2& d) {
    return exact_sign(Positions<glm::dvec2, 4>{&a, &b, &c, &d},
                      [](const auto& rows) { return in_circle_sign(rows); });
}

}  // namespace tetralight
