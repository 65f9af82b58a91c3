// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/harness.h>
#include <tetralight/probes/build/joined_volume.h>
#include <tetralight/probes/build/make_probe_volume.h>
#include <tetralight/probes/build/volume_builder.h>
#include <tetralight/probes/compact_probes.h>

namespace tetralight::bench {
namespace {

/// A room of 1 000 probes in a level of 100 000.
std::vector<ProbeGroup> make_groups() {
    std::vector<glm::dvec3> room = random_positions(1'000, 5, 10.0);
    for (glm::dvec3& p : room) p += glm::dvec3(40.0);
    return {make_group("level", random_positions(100'000, 4, 100.0)),
            make_group("room", std::move(room))};
}

/// Each change of a `VolumeBuilder` gives the bytes of a volume that is made at once.
void bench_builder(const std::vector<ProbeGroup>& groups, double full, const Options& options) {
    const ProbeGroup& room = groups[1];
    const ProbeVolume expected = make_probe_volume(*merge(groups));
    VolumeBuilder builder;
    require(bool(builder.add_group(groups[0])), "adding a group");
    ProbeVolume without = *builder.build();
    ProbeVolume with;
    std::vector<double> added, removed;
    for (int i = 0; i < options.repetitions; ++i) {
        added.push_back(seconds([&] {
            require(bool(builder.add_group(room)), "adding a group");
            with = *builder.build();
        }));
        require(with == expected, "a group that was added gives another volume");
        const ProbeVolume before = std::move(without);
        removed.push_back(seconds([&] {
            require(bool(builder.remove_group(room.name)), "removing a group");
            without = *builder.build();
        }));
        require(without == before, "a group that was removed leaves another volume");
    }
    report("tetrahedralize.builder_add", median(added) / full, "of a full build");
    report("tetrahedralize.builder_remove", median(removed) / full, "of a full build");
}

ProbeVolume lit_volume(const ProbeGroup& group) {
    ProbeVolume volume = make_probe_volume(*merge(std::span(&group, 1)));
    volume.irradiance.resize(volume.positions.size());
    make_compact_probes(volume);
    return volume;
}

/// Works for `budget` at a time; returns the longest time of a step in seconds.
double finish(JoinedVolume& joined, std::chrono::nanoseconds budget) {
    double longest = 0.0;
    for (bool is_done = false; !is_done;) {
        longest = std::max(longest, seconds([&] {
                               const auto step = joined.step(budget);
                               require(bool(step), "a step");
                               is_done = *step;
                           }));
    }
    joined.commit();
    return longest;
}

/// Volumes with light that join and leave while queries read.
void bench_joined(const std::vector<ProbeGroup>& groups, double full, const Options& options) {
    constexpr std::chrono::seconds kAtOnce(10);
    constexpr std::chrono::microseconds kSlice(500);
    const ProbeVolume level = lit_volume(groups[0]), room = lit_volume(groups[1]);
    JoinedVolume joined;
    require(bool(joined.add("level", level.view())), "adding a volume");
    finish(joined, kAtOnce);
    const auto add = [&](std::chrono::nanoseconds budget) {
        require(bool(joined.add("room", room.view())), "adding a volume");
        return finish(joined, budget);
    };
    const auto remove = [&](std::chrono::nanoseconds budget) {
        require(bool(joined.remove("room")), "removing a volume");
        return finish(joined, budget);
    };
    std::vector<double> added, removed, steps;
    for (int i = 0; i < options.repetitions; ++i) {
        added.push_back(seconds([&] { (void)add(kAtOnce); }));
        const uint32_t cells = joined.view().info.inner_cell_count;
        require(cells == joined.canonical().info.inner_cell_count,
                "joined volumes have other cells than a volume made at once");
        removed.push_back(seconds([&] { (void)remove(kAtOnce); }));
        const double in = add(kSlice), out = remove(kSlice);
        steps.push_back(std::max(in, out));
    }
    report("tetrahedralize.group_add", median(added) / full, "of a full build");
    report("tetrahedralize.group_remove", median(removed) / full, "of a full build");
    report("tetrahedralize.longest_step", 1e3 * median(steps), "ms, with a budget of 0.5 ms");
}

}  // namespace

void bench_groups(const Options& options) {
    const std::vector<ProbeGroup> groups = make_groups();
    std::vector<double> full;
    for (int i = 0; i < options.repetitions; ++i) {
        full.push_back(seconds([&] { (void)make_probe_volume(*merge(groups)); }));
    }
    bench_builder(groups, median(full), options);
    bench_joined(groups, median(full), options);
}

}  // namespace tetralight::bench
