// SPDX-License-Identifier: Apache-2.0
// TETRALIGHT_NIGHTLY=1: ten million cases.
#include <tetralight/probes/delaunay/exact_signs.h>

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <string>

#include <tetralight/probes/delaunay/detail/predicates.h>
#include "tests/support/property.h"

namespace tetralight {
namespace {

using glm::dvec2;
using glm::dvec3;
using Rational = mpq_class;
using Row = std::array<Rational, 3>;

Row difference(const dvec3& a, const dvec3& b) {
    return {Rational(a.x) - Rational(b.x), Rational(a.y) - Rational(b.y),
            Rational(a.z) - Rational(b.z)};
}

Rational determinant(const Row& a, const Row& b, const Row& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

Rational square(const Row& a) {
    return a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
}

/// By the definition, with rational numbers.
int orientation(const std::array<dvec3, 5>& p) {
    return sgn(determinant(difference(p[1], p[0]), difference(p[2], p[0]), difference(p[3], p[0])));
}

/// The determinant of four rows, expanded along the column of squares.
int in_sphere(const std::array<dvec3, 5>& p) {
    std::array<Row, 4> r;
    for (size_t i = 0; i < 4; ++i) r[i] = difference(p[i], p[4]);
    return sgn(Rational(square(r[0]) * determinant(r[1], r[2], r[3]) -
                        square(r[1]) * determinant(r[0], r[2], r[3]) +
                        square(r[2]) * determinant(r[0], r[1], r[3]) -
                        square(r[3]) * determinant(r[0], r[1], r[2])));
}

/// Of x and y alone, z = 1 in place of the third coordinate.
int orientation_in_plane(const std::array<dvec3, 5>& p) {
    const Row b = difference(p[1], p[0]), c = difference(p[2], p[0]);
    return sgn(Rational(b[0] * c[1] - b[1] * c[0]));
}

int in_circle(const std::array<dvec3, 5>& p) {
    std::array<Row, 3> r;
    for (size_t i = 0; i < 3; ++i) {
        r[i] = difference(p[i], p[3]);
        r[i][2] = r[i][0] * r[i][0] + r[i][1] * r[i][1];
    }
    return sgn(determinant(r[0], r[1], r[2]));
}

using Random = std::mt19937_64;

struct Family {
    const char* name;
    std::function<double(Random&)> coordinate;
};

double uniform(Random& random) {
    return std::uniform_real_distribution<double>(-1.0, 1.0)(random);
}

int below(Random& random, int count) {
    return static_cast<int>(random() % static_cast<uint64_t>(count));
}

/// Coordinates whose determinants are often 0 or nearly so, of all magnitudes.
const Family kFamilies[] = {
    {"Uniform", uniform},
    {"Lattice", [](Random& r) { return 0.1 * below(r, 5); }},
    {"FarFromTheOrigin", [](Random& r) { return 1e5 + 0.5 * below(r, 3) + below(r, 2) * 0x1p-36; }},
    {"LastBits", [](Random& r) { return below(r, 4) + (below(r, 3) - 1) * 0x1p-52; }},
    {"MixedScales", [](Random& r) { return std::ldexp(uniform(r), below(r, 100) - 50); }},
    {"AllDoubles", [](Random& r) { return std::ldexp(uniform(r), 1020 - below(r, 2200)); }},
    {"Denormals", [](Random& r) { return (below(r, 9) - 4) * 0x1p-1074; }},
};

class ExactSigns : public testing::TestWithParam<Family> {};

INSTANTIATE_TEST_SUITE_P(All, ExactSigns, testing::ValuesIn(kFamilies),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST_P(ExactSigns, AreThoseOfRationalNumbers) {
    const int case_count = test::is_nightly() ? 1'500'000 : 4000;
    Random random(1);
    int zero_count = 0;
    for (int i = 0; i < case_count; ++i) {
        std::array<dvec3, 5> p;
        for (dvec3& position : p) {
            for (int axis = 0; axis < 3; ++axis) position[axis] = GetParam().coordinate(random);
        }
        const auto xy = [&](size_t k) { return dvec2(p[k].x, p[k].y); };
        ASSERT_EQ(exact_orientation(p[0], p[1], p[2], p[3]), orientation(p)) << i;
        ASSERT_EQ(exact_in_sphere(p[0], p[1], p[2], p[3], p[4]), in_sphere(p)) << i;
        ASSERT_EQ(exact_orientation(xy(0), xy(1), xy(2)), orientation_in_plane(p)) << i;
        ASSERT_EQ(exact_in_circle(xy(0), xy(1), xy(2), xy(3)), in_circle(p)) << i;
        zero_count += orientation(p) == 0 ? 1 : 0;

        detail::DelaunayPredicates predicates;
        predicates.include(p);
        ASSERT_EQ(predicates.orientation(p[0], p[1], p[2], p[3]), orientation(p)) << i;
        if (in_sphere(p) != 0) {
            ASSERT_EQ(predicates.in_sphere(p[0], p[1], p[2], p[3], p[4]), in_sphere(p)) << i;
        }
    }
    const std::string name = GetParam().name;
    const bool has_zeros = name == "Lattice" || name == "Denormals";
    EXPECT_GT(zero_count, has_zeros ? case_count / 40 : -1);
}

TEST(ExactSigns, PositionsOnASphereAreNearlySo) {
    Random random(2);
    for (int i = 0; i < 4000; ++i) {
        std::array<dvec3, 5> p;
        for (dvec3& position : p) {
            position = {uniform(random), uniform(random), uniform(random)};
            position /= std::sqrt(position.x * position.x + position.y * position.y +
                                  position.z * position.z);
        }
        ASSERT_EQ(exact_in_sphere(p[0], p[1], p[2], p[3], p[4]), in_sphere(p)) << i;
    }
}

}  // namespace
}  // namespace tetralight
