// SPDX-License-Identifier: Apache-2.0
// Sets of probes on which walks have been long.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <sstream>
#include <string>

#include <tetralight/bench/harness.h>
#include <tetralight/bench/query_worst.h>
#include <tetralight/probes/build/make_probe_volume.h>
#include <tetralight/probes/interpolate.h>

namespace tetralight::bench {
namespace {

using Positions = std::vector<glm::dvec3>;

constexpr size_t kQueryCount = 10'000;

/// Probes, and positions where queries of such a set are.
struct Shape {
    std::string name;
    Positions probes;
    Positions queries;
};

/// A lattice of 300 × 300 probes, 2 m apart, at a height over the ground.
Positions layer(double (*height)(double x, double z)) {
    Positions probes;
    for (int i = 0; i < 300; ++i) {
        for (int k = 0; k < 300; ++k) {
            const double x = 2.0 * (i - 150), z = 2.0 * (k - 150);
            probes.emplace_back(x, height(x, z), z);
        }
    }
    return probes;
}

/// Positions within `reach` of probes, no lower than `low` of it.
Positions near(const Positions& probes, double reach, double low) {
    Positions queries;
    const Positions offsets = random_positions(kQueryCount, 7, 1.0);
    for (size_t i = 0; i < kQueryCount; ++i) {
        const glm::dvec3 offset(2.0 * offsets[i].x - 1.0, low + (1.0 - low) * offsets[i].y,
                                2.0 * offsets[i].z - 1.0);
        queries.push_back(probes[i * 7919 % probes.size()] + reach * offset);
    }
    return queries;
}

Positions on_paraboloid(size_t count) {
    Positions probes = random_positions(count, 3, 200.0);
    for (glm::dvec3& p : probes) {
        const double x = p.x - 100.0, z = p.z - 100.0;
        p = {x, (x * x + z * z) / 100.0, z};
    }
    return probes;
}

Positions on_concentric_spheres(size_t sphere_count, size_t count) {
    Positions probes = random_positions(sphere_count * count, 4, 2.0);
    for (size_t i = 0; i < probes.size(); ++i) {
        const double radius = 0.1 * static_cast<double>(1 + i % sphere_count);
        probes[i] = radius * glm::normalize(probes[i] - 1.0);
    }
    return probes;
}

Positions in_clusters(size_t count) {
    Positions probes = random_positions(count, 5, 0.1);
    for (size_t i = 0; i < count; i += 2) probes[i] += glm::dvec3(1000, 300, -200);
    return probes;
}

std::vector<Shape> shapes() {
    std::vector<Shape> shapes;
    const auto add = [&](const char* name, Positions probes, double reach, double low) {
        Positions queries = near(probes, reach, low);
        shapes.push_back({name, std::move(probes), std::move(queries)});
    };
    add("hill", layer([](double x, double z) { return 101.0 - (x * x + z * z) / 2000.0; }), 2.0,
        0.0);
    add("paraboloid", on_paraboloid(200'000), 0.5, 0.0);
    add("concentric", on_concentric_spheres(1000, 90), 1.0, -1.0);
    add("clusters", in_clusters(20'000), 0.01, -1.0);
    add("heightfield",
        layer([](double x, double z) { return 10.0 * std::sin(x / 20.0) * std::sin(z / 23.0); }),
        2.0, 0.0);
    Positions outlier = random_positions(20'000, 6, 100.0);
    Positions queries = random_positions(kQueryCount, 8, 100.0);
    outlier.emplace_back(1e8, 3e7, -2e7);
    shapes.push_back({"outlier", std::move(outlier), std::move(queries)});
    return shapes;
}

ProbeVolume make_volume(const Positions& probes) {
    const ProbeGroup group = make_group("bench", probes);
    ProbeVolume volume = make_probe_volume(*merge(std::span(&group, 1)));
    volume.irradiance.resize(volume.positions.size());
    return volume;
}

/// Cells tested a query: a fallback tests all of them.
struct Tests {
    double mean = 0.0;
    double most = 0.0;
    double fallbacks = 0.0;  ///< share of the queries
};

Tests count_tests(const ProbeVolume& volume, const Positions& queries) {
    Tests tests;
    for (const glm::dvec3& query : queries) {
        const LocationTrace trace = trace_location(volume.view(), glm::vec3(query));
        const double all = trace.is_fallback ? static_cast<double>(volume.cells.size()) : 0.0;
        const double count = trace.step_count + all;
        tests.fallbacks += trace.is_fallback / static_cast<double>(queries.size());
        tests.mean += count / static_cast<double>(queries.size());
        tests.most = std::max(tests.most, count);
    }
    return tests;
}

/// A batch against as many single calls.
void report_batch(const Shape& shape, const ProbeVolume& volume, const Options& options) {
    constexpr size_t kBatch = 1023;
    std::vector<glm::vec3> positions(shape.queries.begin(), shape.queries.begin() + kBatch);
    std::vector<CellLocation> batch(kBatch), single(kBatch);
    Contest contest;
    contest.figure = "query.worst_batch." + shape.name;
    contest.unit = "Mq/s";
    contest.work = kBatch * 1e-6;
    contest.baseline_is = "as many single calls";
    contest.ours = [&] { return seconds([&] { locate(volume.view(), positions, batch); }); };
    contest.baseline = [&] {
        return seconds([&] {
            for (size_t i = 0; i < kBatch; ++i) single[i] = locate(volume.view(), positions[i]);
        });
    };
    run(contest, options);
    require(batch == single, contest.figure + ": answers differ from those of single calls");
}

/// Positions around the probes, so many extents of the volume away.
Positions around(const ProbeVolume& volume, double extents) {
    Positions queries = random_positions(kQueryCount, 9, 2.0);
    for (glm::dvec3& q : queries) {
        const double distance = extents * static_cast<double>(volume.info.extent);
        q = volume.info.world_origin + distance * glm::normalize(q - 1.0);
    }
    return queries;
}

/// Sets of two scales, from far away: tests a query, and the share of queries that search all
/// cells.
void report_far_queries() {
    const auto report_set = [](const std::string& name, const Positions& probes) {
        const ProbeVolume volume = make_volume(probes);
        for (const double extents : {2.0, 1e4, 1e6}) {
            const Tests tests = count_tests(volume, around(volume, extents));
            std::ostringstream figure;
            figure << "query.far." << name << "." << extents;
            report(figure.str(), tests.mean, "tests/query");
            report(figure.str() + ".most", tests.most, "tests/query");
            report(figure.str() + ".fallbacks", tests.fallbacks, "of the queries");
        }
    };
    report_set("clusters", in_clusters(20'000));
    for (const double distance : {1e6, 1e8, 1e10, 1e12}) {
        Positions probes = random_positions(20'000, 6, 100.0);
        probes.emplace_back(distance * glm::dvec3(1.0, 0.3, -0.2));
        std::ostringstream name;
        name << "outlier_" << distance;
        report_set(name.str(), probes);
    }
}

}  // namespace

void report_worst_queries(const Options& options) {
    for (const Shape& shape : shapes()) {
        const ProbeVolume volume = make_volume(shape.probes);
        const double side = 100.0;
        const ProbeVolume random = make_volume(random_positions(shape.probes.size(), 1, side));
        const Tests ours = count_tests(volume, shape.queries);
        const Tests usual = count_tests(random, random_positions(kQueryCount, 2, side));
        const std::string figure = "query.worst." + shape.name;
        report_contest(figure, ours.mean, usual.mean, "tests/query", "as many random probes");
        report_contest(figure + ".most", ours.most, usual.most, "tests/query",
                       "as many random probes");
        report(figure + ".fallbacks", ours.fallbacks, "of the queries");
        report_batch(shape, volume, options);
    }
    report_far_queries();
}

}  // namespace tetralight::bench
