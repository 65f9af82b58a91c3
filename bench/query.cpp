// SPDX-License-Identifier: Apache-2.0
// Links CGAL's 3D triangulations (GPL-3.0-or-later).
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <thread>

#include <tetralight/bench/harness.h>
#include <tetralight/bench/matrix_walk.h>
#include <tetralight/bench/query_subject.h>
#include <tetralight/bench/query_worst.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/probe_file.h>

namespace tetralight::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel>;

constexpr size_t kMillion = 1'000'000;

/// One batch with its answers, and the same answers gathered at known locations.
struct Race {
    Subject& subject;
    ProbeVolumeView view;
    std::vector<glm::vec3> positions;
    std::vector<CellLocation> locations;
    std::vector<uint32_t> hints;
    std::vector<uint64_t> sort_memory;
    std::vector<IrradianceSh> answers;
    std::vector<IrradianceSh> gathered;

    Race(Subject& from, const ProbeVolumeView& volume, size_t count)
        : subject(from), view(volume), locations(count), answers(count), gathered(count) {}

    void set_positions(std::vector<glm::vec3> fresh) {
        positions = std::move(fresh);
        locate(view, positions, locations);
    }

    [[nodiscard]] double run_batch() {
        const InterpolationBatch batch{positions, hints, answers, {}, {}, sort_memory};
        return seconds([&] { require(bool(interpolate(view, batch)), "batch query"); });
    }

    [[nodiscard]] double run_gather() {
        return seconds([&] { require(bool(blend(view, locations, gathered, {})), "gather"); });
    }

    void compare(const std::string& figure) const {
        for (size_t i = 0; i < answers.size(); ++i) {
            for (int k = 0; k < kShCoefficientCount; ++k) {
                const glm::vec3 a = answers[i].coefficients[k];
                require(glm::distance(a, gathered[i].coefficients[k]) <= 1e-3f * glm::length(a),
                        figure + ": answers differ from the gathered ones");
            }
        }
    }
};

Contest contest_of(const std::string& figure, size_t count, const char* baseline) {
    Contest contest;
    contest.figure = figure;
    contest.unit = "Mq/s";
    contest.baseline_is = baseline;
    contest.work = static_cast<double>(count) * 1e-6;
    return contest;
}

/// Short batches are repeated, so that a run takes milliseconds.
template <class Run>
double repeated(size_t count, Run run) {
    const size_t times = std::max<size_t>(1, 50'000 / count);
    double sum = 0.0;
    for (size_t i = 0; i < times; ++i) sum += run();
    return sum / static_cast<double>(times);
}

/// Ticks of the time stamp counter, which runs at the nominal clock rate.
uint64_t ticks() {
#if defined(__x86_64__)
    return __builtin_ia32_rdtsc();
#else
    return 0;
#endif
}

void report_cycles(const std::string& name, Race& race) {
    const uint64_t begin = ticks();
    require(race.run_batch() > 0.0, "batch");
    const auto cycles = static_cast<double>(ticks() - begin);
    report("query.cycles." + name, cycles / static_cast<double>(race.positions.size()),
           "cycles/query");
}

void sorted(Subject& subject, const std::string& figure, const ProbeVolumeView& view, size_t count,
            const Options& options) {
    Race race(subject, view, count);
    Contest contest = contest_of(figure, count, "gather only");
    contest.ours = [&] {
        race.set_positions(subject.sorted_positions(count));
        return repeated(count, [&] { return race.run_batch(); });
    };
    contest.baseline = [&] { return repeated(count, [&] { return race.run_gather(); }); };
    run(contest, options);
    race.compare(figure);
    if (count == kMillion && view.compact.size() > 0) report_cycles(subject.name, race);
}

void unsorted(Subject& subject, const std::string& figure, size_t count, const Options& options) {
    Race race(subject, subject.volume.view(), count);
    Race presorted(subject, subject.volume.view(), count);
    race.sort_memory.resize(2 * count);
    Contest contest = contest_of(figure, count, "the same batch, sorted before");
    contest.ours = [&] {
        race.set_positions(subject.positions(count));
        return repeated(count, [&] { return race.run_batch(); });
    };
    contest.baseline = [&] {
        presorted.positions = subject.sorted_positions(count);
        return repeated(count, [&] { return presorted.run_batch(); });
    };
    run(contest, options);
    require(race.run_gather() >= 0.0, "gather");
    race.compare(figure);
}

/// Unsorted objects that move a tenth of a cell a frame, with the hints of the last frame.
void moving(Subject& subject, const std::string& figure, size_t count, const Options& options) {
    Race race(subject, subject.volume.view(), count);
    race.hints.assign(count, kNoIndex);
    race.positions = subject.positions(count);
    require(race.run_batch() > 0.0, "first frame");
    const glm::vec3 size = subject.max - subject.min;
    const float spacing =
        std::cbrt(size.x * size.y * size.z / static_cast<float>(subject.volume.positions.size()));
    Contest contest = contest_of(figure, count, "gather only");
    contest.ours = [&] {
        const std::vector<glm::dvec3> steps = random_positions(count, ++subject.seed, 1.0);
        std::vector<glm::vec3> moved = race.positions;
        for (size_t i = 0; i < count; ++i) {
            moved[i] += 0.1f * spacing * (2.0f * glm::vec3(steps[i]) - 1.0f);
        }
        race.set_positions(std::move(moved));
        return race.run_batch();
    };
    contest.baseline = [&] { return race.run_gather(); };
    run(contest, options);
    race.compare(figure);
}

/// What walls cost: the same batch with them and without.
void walls(Subject& subject, const Options& options) {
    add_random_walls(subject.volume, 0.044);  // marks 42 % of the cells, as in Sponza
    for (const bool is_hinted : {false, true}) {
        const size_t count = is_hinted ? 100'000 : kMillion;
        Race race(subject, subject.volume.view(), count);
        if (is_hinted) race.hints.assign(count, kNoIndex);
        const std::string kind = is_hinted ? "hinted." : "sorted.";
        Contest contest =
            contest_of("query.walls." + kind + subject.name, count, "the same, walls ignored");
        const auto run_with = [&](Walls walls) {
            const InterpolationBatch batch{.positions = race.positions,
                                           .hints = race.hints,
                                           .irradiance = race.answers,
                                           .walls = walls};
            return seconds([&] { require(bool(interpolate(race.view, batch)), "walls"); });
        };
        contest.ours = [&] {
            race.positions = is_hinted ? subject.positions(count) : subject.sorted_positions(count);
            require(run_with(Walls::Ignore) > 0.0, "hints of the last frame");
            return run_with(Walls::HideProbes);
        };
        contest.baseline = [&] { return run_with(Walls::Ignore); };
        run(contest, options);
    }
    subject.volume.visibility_blocks.clear();
    subject.volume.cell_visibility.clear();
}

void location_alone(Subject& subject, const std::string& figure, size_t count,
                    const Options& options) {
    std::vector<Kernel::Point_3> points;
    for (const glm::vec3& p : subject.volume.positions) points.emplace_back(p.x, p.y, p.z);
    const Delaunay delaunay(points.begin(), points.end());
    const ProbeVolumeView view = subject.volume.view();
    std::vector<glm::vec3> positions;
    std::vector<CellLocation> locations(count);
    size_t ours_outside = 0;
    size_t theirs_outside = 0;
    Contest contest = contest_of(figure, count, "CGAL locate, last cell as hint, sorted");
    contest.ours = [&] {
        positions = subject.sorted_positions(count);
        return seconds([&] { locate(view, positions, locations); });
    };
    contest.baseline = [&] {
        theirs_outside = 0;
        return seconds([&] {
            Delaunay::Cell_handle cell = delaunay.infinite_cell();
            for (const glm::vec3& p : positions) {
                cell = delaunay.locate({p.x, p.y, p.z}, cell);
                theirs_outside += delaunay.is_infinite(cell);
            }
        });
    };
    run(contest, options);
    for (const CellLocation& location : locations) {
        ours_outside += location.cell >= view.info.inner_cell_count;
    }
    const auto difference = static_cast<double>(ours_outside) - static_cast<double>(theirs_outside);
    require(std::abs(difference) <= 1e-5 * static_cast<double>(count),
            figure + ": CGAL finds other positions outside");
}

/// Sorted positions inside the hull, against the walk that engines ship and the same blend.
void against_matrices(Subject& subject, const Options& options) {
    const MatrixWalk matrices(subject.volume.view());
    Race race(subject, subject.volume.view(), kMillion);
    const std::string figure = "query.matrix." + subject.name;
    Contest contest = contest_of(figure, kMillion, "a matrix a cell, the last cell as hint");
    const glm::vec3 margin = 0.1f * (subject.max - subject.min);
    Subject inside{subject.name, {}, subject.min + margin, subject.max - margin};
    contest.ours = [&] {
        inside.seed = ++subject.seed;
        race.positions = inside.sorted_positions(kMillion);
        return race.run_batch();
    };
    contest.baseline = [&] {
        return seconds([&] { matrices.locate(race.positions, race.locations); }) +
               race.run_gather();
    };
    run(contest, options);
    race.compare(figure);
}

void steps(Subject& subject, size_t count) {
    const std::vector<glm::vec3> positions = subject.sorted_positions(count);
    const ProbeVolumeView view = subject.volume.view();
    std::vector<uint32_t> counts;
    uint32_t hint = kNoIndex;
    double fallbacks = 0.0;
    double sum = 0.0;
    for (const glm::vec3& p : positions) {
        const LocationTrace trace = trace_location(view, p, hint);
        hint = trace.location.cell;
        counts.push_back(trace.step_count);
        fallbacks += trace.is_fallback;
        sum += trace.step_count;
    }
    std::ranges::sort(counts);
    report("query.steps_p50." + subject.name, counts[count / 2], "cells");
    report("query.steps_p99." + subject.name, counts[count * 99 / 100], "cells");
    report("query.steps_max." + subject.name, counts.back(), "cells");
    report("query.fallbacks." + subject.name, fallbacks, "queries");
    const double tests = sum / static_cast<double>(count);
    constexpr double kTestBytes = sizeof(Cell) + 4 * sizeof(glm::vec3);
    constexpr double kBlendBytes = 4 * sizeof(CompactProbe) + sizeof(IrradianceSh);
    report("query.bytes." + subject.name, tests * kTestBytes + kBlendBytes, "bytes/query");
}

void threads(Subject& subject, const Options& options) {
    const size_t thread_count = std::max(1u, std::thread::hardware_concurrency());
    Race race(subject, subject.volume.view(), kMillion);
    const auto parallel_for = [&](size_t count, auto&& task) {
        std::atomic<size_t> next = 0;
        std::vector<std::jthread> workers;
        for (size_t t = 0; t < thread_count; ++t) {
            workers.emplace_back([&] {
                for (size_t i = next++; i < count; i = next++) task(i);
            });
        }
    };
    Contest contest = contest_of("query.threads", kMillion, "one thread, times the threads");
    contest.ours = [&] {
        race.set_positions(subject.sorted_positions(kMillion));
        const InterpolationBatch batch{race.positions, {}, race.answers, {}, {}, {}};
        return seconds(
            [&] { require(bool(interpolate(race.view, batch, parallel_for)), "parallel batch"); });
    };
    contest.baseline = [&] { return race.run_batch() / static_cast<double>(thread_count); };
    run(contest, options);
}

/// Opening a file lazily and one query, as a fraction of the time to read it.
void open_lazy(const Subject& subject, const Options& options) {
    const std::string path = "/tmp/tetralight_bench.probes";
    require(bool(write_probe_file(path, subject.volume.view())), "write");
    Contest contest = contest_of("query.open_lazy", kMillion, "reading and verifying the file");
    contest.unit = "1/s";
    contest.work = 1.0;
    contest.ours = [&] {
        return seconds([&] {
            const auto file = open_probe_file_lazy(path);
            require(bool(file), "open");
            const auto location = locate(file->view(), 0.5f * (subject.min + subject.max));
            require(interpolate(file->view(), location).occlusion.x == 1.0f, "answer");
        });
    };
    contest.baseline = [&] { return seconds([&] { require(bool(read_file(path)), "read"); }); };
    contest.baseline_is = "reading the file once";
    run(contest, options);
    std::remove(path.c_str());
}

/// All figures of one volume.
void ask(Subject subject, const Options& options) {
    const ProbeVolumeView half = subject.volume.view();
    const std::string& name = subject.name;
    sorted(subject, "query.sorted." + name, half, kMillion, options);
    sorted(subject, "query.sorted_10k." + name, half, 10'000, options);
    sorted(subject, "query.sorted_1023." + name, half, 1'023, options);
    sorted(subject, "query.sorted_float." + name, half.without_compact(), kMillion, options);
    unsorted(subject, "query.unsorted." + name, kMillion, options);
    moving(subject, "query.moving." + name, 100'000, options);
    if (name != "scene") walls(subject, options);
    location_alone(subject, "query.locate." + name, kMillion, options);
    if (name == "20k") against_matrices(subject, options);
    steps(subject, kMillion);
    if (name != "1m" && !(options.is_quick && name == "20k")) return;
    threads(subject, options);
    open_lazy(subject, options);
}

}  // namespace

void bench_query(const Options& options) {
    std::vector<std::pair<std::string, size_t>> sizes{{"2k", 2'000}, {"20k", 20'000}};
    if (!options.is_quick) sizes.insert(sizes.end(), {{"200k", 200'000}, {"1m", kMillion}});
    for (const auto& [name, count] : sizes) ask(make_random_subject(name, count), options);
    ask(make_scene_subject(options), options);
    if (!options.is_quick) report_worst_queries(options);
}

}  // namespace tetralight::bench
