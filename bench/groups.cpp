// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/harness.h>
#include <tetralight/probes/build/make_probe_volume.h>
#include <tetralight/probes/build/volume_builder.h>

namespace tetralight::bench {
namespace {

/// A room of 1 000 probes in a level of 100 000.
std::vector<ProbeGroup> make_groups() {
    std::vector<glm::dvec3> room = random_positions(1'000, 5, 10.0);
    for (glm::dvec3& p : room) p += glm::dvec3(40.0);
    return {make_group("level", random_positions(100'000, 4, 100.0)),
            make_group("room", std::move(room))};
}

}  // namespace

void bench_groups(const Options& options) {
    const std::vector<ProbeGroup> groups = make_groups();
    const ProbeGroup& room = groups[1];
    VolumeBuilder builder;
    require(bool(builder.add_group(groups[0])), "adding a group");
    ProbeVolume without = *builder.build();
    ProbeVolume with;

    std::vector<double> full, added, removed;
    for (int i = 0; i < options.repetitions; ++i) {
        full.push_back(seconds([&] { with = make_probe_volume(*merge(groups)); }));
        const ProbeVolume expected = std::move(with);
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
    report("tetrahedralize.group_add", median(added) / median(full), "of a full build");
    report("tetrahedralize.group_remove", median(removed) / median(full), "of a full build");
}

}  // namespace tetralight::bench
