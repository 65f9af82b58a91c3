// SPDX-License-Identifier: Apache-2.0
// Links CGAL's 3D triangulations (GPL-3.0-or-later).
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <random>

#include <tetralight/bench/harness.h>
#include <tetralight/probes/build/hilbert_order.h>
#include <tetralight/probes/delaunay/delaunay_tetrahedra.h>

namespace tetralight::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel>;
using Positions = std::vector<glm::dvec3>;

size_t finite_count(const DelaunayTetrahedra& tetrahedra) {
    return static_cast<size_t>(std::ranges::count_if(tetrahedra.cells(), &DelaunayCell::is_finite));
}

/// From positions in any order to all tetrahedra: both put them in an order of their own first.
void contest(const std::string& name, const Positions& positions, const Options& options) {
    std::vector<Kernel::Point_3> points;
    for (const glm::dvec3& p : positions) points.emplace_back(p.x, p.y, p.z);
    size_t our_cells = 0, their_cells = 0;
    Contest contest;
    contest.figure = "delaunay." + name;
    contest.unit = "Mprobes/s";
    contest.baseline_is = "CGAL::Delaunay_triangulation_3 range constructor";
    contest.work = static_cast<double>(points.size()) * 1e-6;
    contest.ours = [&] {
        DelaunayTetrahedra tetrahedra;
        const double time = seconds([&] {
            Positions ordered;
            ordered.reserve(positions.size());
            for (const uint32_t i : hilbert_order(positions)) ordered.push_back(positions[i]);
            std::vector<uint32_t> vertices(ordered.size());
            require(bool(tetrahedra.insert(ordered, vertices)), "inserting positions");
        });
        our_cells = finite_count(tetrahedra);
        return time;
    };
    contest.baseline = [&] {
        Delaunay delaunay;
        const double time = seconds([&] { delaunay = Delaunay(points.begin(), points.end()); });
        their_cells = delaunay.number_of_finite_cells();
        return time;
    };
    run(contest, options);
    require(our_cells == their_cells, contest.figure + ": tetrahedra differ from CGAL's");
}

template <class Make>
Positions make_positions(size_t count, const Make& make) {
    std::mt19937_64 random(1);
    Positions positions;
    for (size_t i = 0; i < count; ++i) positions.push_back(make(random));
    return positions;
}

double uniform(std::mt19937_64& random) {
    return std::uniform_real_distribution<double>(-1.0, 1.0)(random);
}

glm::dvec3 normal(std::mt19937_64& random) {
    std::normal_distribution<double> distribution;
    const double x = distribution(random), y = distribution(random), z = distribution(random);
    return {x, y, z};
}

glm::dvec3 on_sphere(std::mt19937_64& random) {
    const glm::dvec3 v = normal(random);
    return v / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

/// A thousandth of a metre around one of a hundred places.
glm::dvec3 in_clusters(std::mt19937_64& random) {
    static const Positions kCenters = random_positions(100, 7, 1.0);
    const glm::dvec3& center = kCenters[random() % kCenters.size()];
    return center + 1e-3 * normal(random);
}

glm::dvec3 on_heights(std::mt19937_64& random) {
    const double x = uniform(random), y = uniform(random);
    return {x, y, 0.1 * std::sin(9.0 * x) * std::cos(7.0 * y)};
}

glm::dvec3 on_paraboloid(std::mt19937_64& random) {
    const double x = uniform(random), y = uniform(random);
    return {x, y, x * x + y * y};
}

}  // namespace

void bench_delaunay(const Options& options) {
    constexpr size_t kCount = 100'000;
    contest("10k", random_positions(10'000, 1, 1.0), options);
    contest("100k", random_positions(kCount, 2, 1.0), options);
    contest("sphere", make_positions(kCount, on_sphere), options);
    contest("clusters", make_positions(kCount, in_clusters), options);
    contest("heights", make_positions(kCount, on_heights), options);
    contest("paraboloid", make_positions(kCount, on_paraboloid), options);
    if (options.is_quick) return;
    contest("1m", random_positions(1'000'000, 3, 1.0), options);
    contest("lattice", lattice_positions(100, 0.5), options);
}

}  // namespace tetralight::bench
