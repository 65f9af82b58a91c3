// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>

#include <tetralight/base/box.h>
#include <tetralight/probes/delaunay/exact_signs.h>

namespace tetralight::detail {

/// The signs that a Delaunay tetrahedralization needs, exact for all finite doubles: in doubles as
/// far as a bound of their rounding error decides (for all positions, then for those at hand), else
/// with integers (exact_signs.h).
///
/// Rounding errors are those of Shewchuk, "Adaptive precision floating-point arithmetic and fast
/// robust geometric predicates" (1997): less than 8 ε of the sum of the magnitudes of all products
/// for `orientation`, 16 ε for `in_sphere`, with ε = 2^-53. Here half of the bound is to spare.
class DelaunayPredicates {
  public:
    /// Positions of later calls are among those that were included.
    void include(std::span<const glm::dvec3> positions);

    /// The sign of dot(b − a, cross(c − a, d − a)).
    [[nodiscard]] int orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                                  const glm::dvec3& d) const {
        const glm::dvec3 p = b - a, q = c - a, r = d - a;
        const double determinant = p.x * (q.y * r.z - q.z * r.y) + p.y * (q.z * r.x - q.x * r.z) +
                                   p.z * (q.x * r.y - q.y * r.x);
        if (determinant > orientation_error_) return 1;
        if (determinant < -orientation_error_) return -1;
        const glm::dvec3 size = largest(magnitude(p), magnitude(q), magnitude(r));
        const double error = orientation_error(size);
        if (determinant > error) return 1;
        if (determinant < -error) return -1;
        return has_zero(size) ? 0 : close_orientation(a, b, c, d);
    }

    /// 1 if e lies in the circumsphere of a positively oriented tetrahedron, −1 if outside. Of five
    /// positions on one sphere, each is moved outwards a little, those that are greater by x, y, z
    /// far more than others: there is one answer for all orders of insertion (Devillers and
    /// Teillaud, "Perturbations and vertex removal in a 3D Delaunay triangulation", 2003).
    [[nodiscard]] int in_sphere(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                                const glm::dvec3& d, const glm::dvec3& e) const {
        const glm::dvec3 p = a - e, q = b - e, r = c - e, s = d - e;
        const double pq = p.x * q.y - q.x * p.y, qr = q.x * r.y - r.x * q.y;
        const double rs = r.x * s.y - s.x * r.y, sp = s.x * p.y - p.x * s.y;
        const double pr = p.x * r.y - r.x * p.y, qs = q.x * s.y - s.x * q.y;
        const double pqr = p.z * qr - q.z * pr + r.z * pq, qrs = q.z * rs - r.z * qs + s.z * qr;
        const double rsp = r.z * sp + s.z * pr + p.z * rs, spq = s.z * pq + p.z * qs + q.z * sp;
        const double determinant =
            (square(p) * qrs - square(q) * rsp) + (square(r) * spq - square(s) * pqr);
        if (determinant > in_sphere_error_) return 1;
        if (determinant < -in_sphere_error_) return -1;
        const glm::dvec3 size =
            largest(magnitude(p), largest(magnitude(q), magnitude(r), magnitude(s)));
        const double error = in_sphere_error(size);
        if (determinant > error) return 1;
        if (determinant < -error) return -1;
        return close_in_sphere({&a, &b, &c, &d, &e}, has_zero(size));
    }

    /// True if the positions lie on one line.
    [[nodiscard]] static bool are_collinear(const glm::dvec3& a, const glm::dvec3& b,
                                            const glm::dvec3& c);

  private:
    using Positions = std::array<const glm::dvec3*, 5>;

    static constexpr double kEpsilon = 0x1p-53;
    static constexpr double kInfinity = std::numeric_limits<double>::infinity();

    // Without branches, which glm::abs and glm::max have: signs cannot be predicted.
    static glm::dvec3 magnitude(const glm::dvec3& v) {
        return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)};
    }

    static glm::dvec3 largest(const glm::dvec3& a, const glm::dvec3& b) {
        return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
    }

    static glm::dvec3 largest(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        return largest(a, largest(b, c));
    }

    static double square(const glm::dvec3& v) { return v.x * v.x + v.y * v.y + v.z * v.z; }

    /// True where no product that counts is lost below the least double, and none overflows.
    static bool is_in_range(const glm::dvec3& size, double volume) {
        const double longest = std::max(size.x, std::max(size.y, size.z));
        return longest < 1e60 && volume > 1e-250 * longest;
    }

    /// `size`: the largest differences of coordinates. The six products of three are smaller than
    /// their volume.
    static double orientation_error(const glm::dvec3& size) {
        const double volume = size.x * size.y * size.z;
        return is_in_range(size, volume) ? 6.0 * 16.0 * kEpsilon * volume : kInfinity;
    }

    /// 24 products of three, times the square of a length.
    static double in_sphere_error(const glm::dvec3& size) {
        const double volume = size.x * size.y * size.z;
        return is_in_range(size, volume) ? 24.0 * 32.0 * kEpsilon * volume * square(size)
                                         : kInfinity;
    }

    /// True if a column of a determinant is 0.
    static bool has_zero(const glm::dvec3& size) {
        return size.x == 0.0 || size.y == 0.0 || size.z == 0.0;
    }

    [[nodiscard]] int close_orientation(const glm::dvec3& a, const glm::dvec3& b,
                                        const glm::dvec3& c, const glm::dvec3& d) const;
    [[nodiscard]] int close_in_sphere(const Positions& positions, bool is_zero) const;
    [[nodiscard]] int perturbed_in_sphere(Positions positions) const;

    double orientation_error_ = 0.0;
    double in_sphere_error_ = 0.0;
    Box<glm::dvec3> box_ = Box<glm::dvec3>::empty();
    ExponentRange exponents_;
    /// 1 / unit if coordinates are small whole numbers of units, else 0.
    double per_unit_ = 0.0;
};

}  // namespace tetralight::detail
