// SPDX-License-Identifier: Apache-2.0
// Links CGAL's 3D triangulations (GPL-3.0-or-later).
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <glm/gtc/matrix_transform.hpp>

#include <tetralight/bench/harness.h>
#include <tetralight/probes/build/make_probe_volume.h>
#include <tetralight/probes/build/quality.h>

namespace tetralight::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel>;

void build(const std::string& name, std::vector<glm::dvec3> positions, const Options& options) {
    std::vector<Kernel::Point_3> points;
    for (const glm::dvec3& p : positions) points.emplace_back(p.x, p.y, p.z);
    const ProbeGroup group = make_group("bench", std::move(positions));

    size_t our_cells = 0;
    size_t their_cells = 0;
    Contest contest;
    contest.figure = "tetrahedralize.build." + name;
    contest.unit = "Mprobes/s";
    contest.baseline_is = "CGAL::Delaunay_triangulation_3 range constructor";
    contest.work = static_cast<double>(points.size()) * 1e-6;
    contest.ours = [&] {
        return seconds([&] {
            our_cells = make_probe_volume(*merge(std::span(&group, 1))).info.inner_cell_count;
        });
    };
    contest.baseline = [&] {
        return seconds(
            [&] { their_cells = Delaunay(points.begin(), points.end()).number_of_finite_cells(); });
    };
    run(contest, options);
    require(our_cells == their_cells, contest.figure + ": tetrahedra differ from CGAL's");
}

template <class T>
size_t byte_count(const std::vector<T>& values) {
    return values.size() * sizeof(T);
}

/// Bytes that queries read (with light in half floats), and bytes that stay in the file.
void bytes_per_probe() {
    constexpr size_t kHalfFloatProbe = 64;
    const ProbeGroup group = make_group("bench", random_positions(100'000, 2, 1.0));
    const ProbeVolume volume = make_probe_volume(*merge(std::span(&group, 1)));
    const auto count = static_cast<double>(volume.positions.size());
    const size_t resident = byte_count(volume.positions) + byte_count(volume.cells) +
                            byte_count(volume.hull_rays) + byte_count(volume.seed_grid);
    const size_t cold = byte_count(volume.exact_positions) + byte_count(volume.sources);
    const size_t cold_light = sizeof(IrradianceSh) + sizeof(glm::vec4) + sizeof(float);
    report("tetrahedralize.bytes_per_probe",
           static_cast<double>(resident) / count + kHalfFloatProbe, "B");
    report("tetrahedralize.cold_bytes_per_probe",
           static_cast<double>(cold) / count + static_cast<double>(cold_light), "B");
}

/// Percentage of slivers in a rotated and translated lattice, with snapping and without.
void slivers(int side) {
    glm::dmat4 placed = glm::translate(glm::dmat4(1.0), glm::dvec3(123.4, 5.6, -78.9));
    placed = glm::rotate(placed, 0.7, glm::dvec3(1, 2, 3));
    std::vector<glm::dvec3> positions = lattice_positions(side, 1.0);
    for (glm::dvec3& p : positions) p = glm::dvec3(placed * glm::dvec4(p, 1.0));
    const auto sliver_percent = [](const ProbeVolume& volume) {
        const std::span cells = std::span(volume.cells).first(volume.info.inner_cell_count);
        return 100.0 * measure_quality(volume.exact_positions, cells).sliver_fraction();
    };

    const ProbeGroup group = make_group("bench", positions);
    const MergedProbes merged = *merge(std::span(&group, 1));
    MergedProbes as_rounded = merged;
    as_rounded.positions = std::move(positions);
    report("tetrahedralize.slivers", sliver_percent(make_probe_volume(merged)), "%");
    report("tetrahedralize.slivers_not_snapped", sliver_percent(make_probe_volume(as_rounded)),
           "%");
}

ProbeVolume build_million() {
    const ProbeGroup group = make_group("bench", random_positions(1'000'000, 3, 1.0));
    return make_probe_volume(*merge(std::span(&group, 1)));
}

}  // namespace

void bench_tetrahedralize(const Options& options) {
    if (options.only == "memory") (void)build_million();
    if (options.only) return;  // a process of peak_memory()
    bench_delaunay(options);
    build("10k", random_positions(10'000, 1, 1.0), options);
    build("100k", random_positions(100'000, 2, 1.0), options);
    bytes_per_probe();
    slivers(60);
    bench_groups(options);
    if (options.is_quick) return;
    report("tetrahedralize.peak_memory", 1e-6 * peak_memory({"tetrahedralize", "--only", "memory"}),
           "MB");
    build("1m", random_positions(1'000'000, 3, 1.0), options);
    build("lattice", lattice_positions(100, 1.0), options);
}

}  // namespace tetralight::bench
