// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lppv/lppv.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>

#include <tetralight/bench/harness.h>
#include <tetralight/bench/lppv_accuracy.h>
#include <tetralight/bench/query_subject.h>
#include <tetralight/lppv/lppv_atlas.h>
#include <tetralight/probes/build/make_probe_volume.h>
#include <tetralight/probes/compact_probes.h>
#ifdef TETRALIGHT_HAS_OPENVDB
#include <tetralight/bench/vdb_baseline.h>
#include <tetralight/lppv/vdb/write_vdb.h>
#endif

namespace tetralight::bench {
namespace {

LppvGrid make_grid(const glm::dmat4& world_from_object, const glm::dvec3& size,
                   const LppvSettings& settings) {
    const LppvPart box{world_from_object, -0.5 * size, 0.5 * size};
    const auto grid = make_lppv_grid({world_from_object, std::span(&box, 1)}, settings);
    require(bool(grid), "grid");
    return *grid;
}

LppvSettings with_resolution(glm::uvec3 resolution) {
    LppvSettings settings;
    settings.resolution_mode = LppvResolution::Custom;
    settings.resolution = resolution;
    return settings;
}

/// A grid over the probes' box grown by 10 %, as the subject's positions.
LppvGrid grid_over(const Subject& subject, uint32_t side) {
    const glm::dvec3 center(0.5f * (subject.min + subject.max));
    return make_grid(glm::translate(glm::dmat4(1.0), center),
                     glm::dvec3(1.1f * (subject.max - subject.min)),
                     with_resolution(glm::uvec3(side)));
}

/// Filling an allocated grid, and a new one, against a sorted batch of as many queries in the same
/// box, as in `query.sorted`.
void fill(Subject& subject, uint32_t side, const Options& options) {
    const LppvGrid grid = grid_over(subject, side);
    const size_t count = grid.point_count();
    const size_t times = std::max<size_t>(1, 200'000 / count);
    const ProbeVolumeView view = subject.volume.view();
    Lppv lppv = *make_lppv(view, grid, {});
    std::vector<IrradianceSh> answers(count);
    Contest contest;
    contest.unit = "Mpoints/s";
    contest.baseline_is = "a sorted batch of as many queries in the same box";
    contest.work = static_cast<double>(count * times) * 1e-6;
    contest.baseline = [&] {
        const std::vector<glm::vec3> positions = subject.sorted_positions(count);
        const InterpolationBatch batch{positions, {}, answers};
        return seconds([&] {
            for (size_t i = 0; i < times; ++i) require(bool(interpolate(view, batch)), "batch");
        });
    };
    contest.figure = "lppv.fill." + std::to_string(side);
    contest.ours = [&] {
        return seconds([&] {
            for (size_t i = 0; i < times; ++i) require(bool(fill_lppv(view, {}, lppv)), "fill");
        });
    };
    run(contest, options);
    contest.figure = "lppv.make." + std::to_string(side);
    contest.ours = [&] {
        return seconds([&] {
            for (size_t i = 0; i < times; ++i) require(bool(make_lppv(view, grid, {})), "make");
        });
    };
    run(contest, options);
}

/// 20 000 probes in 20 groups side by side along x.
ProbeVolume make_grouped_volume() {
    std::vector<ProbeGroup> groups;
    for (int g = 0; g < 20; ++g) {
        auto positions = random_positions(1000, static_cast<uint64_t>(g) + 1, 100.0);
        for (glm::dvec3& p : positions) p.x = 5.0 * g + 0.05 * p.x;
        groups.push_back(make_group("group " + std::to_string(g), std::move(positions)));
    }
    ProbeVolume volume = make_probe_volume(*merge(groups));
    for (const glm::vec3& p : volume.positions) {
        volume.irradiance.push_back(irradiance_from_radiance(constant_radiance(p)));
    }
    make_compact_probes(volume);
    return volume;
}

/// A beam at a random position among the probes, rotated about y.
LppvGrid beam_at(const glm::dvec3& position, double angle) {
    const glm::dmat4 world_from_beam =
        glm::rotate(glm::translate(glm::dmat4(1.0), position), angle, glm::dvec3(0, 1, 0));
    return make_grid(world_from_beam, {1.0, 1.0, 8.0}, with_resolution({2, 2, 16}));
}

/// 1 000 volumes. In each frame a tenth of them moves and the light of one group changes.
class Frames {
  public:
    Frames() : volume_(make_grouped_volume()), atlas_({.slab_size = {80, 80, 144}}) {
        for (const glm::dvec3& p : random_positions(1000, 77, 100.0)) {
            grids_.push_back(beam_at(p, p.y));
            require(bool(atlas_.add(grids_.back(), LppvQuality::Normal, LppvRefresh::Automatic)),
                    "room in the atlas");
        }
        atlas_.refresh(volume_.view(), {});
        const std::vector<uint32_t> group{9};
        changed_ = probes_of_groups(volume_.view(), group);
    }

    /// Moves a tenth, changes the group's light, and returns the seconds of the refresh.
    double refresh() {
        ++frame_;
        const auto places = random_positions(100, 1000 + frame_, 100.0);
        for (uint32_t i = 0; i < 100; ++i) {
            const uint32_t id = 10 * i + static_cast<uint32_t>(frame_ % 10);
            // The distance that an object moves in a few frames.
            const glm::dvec3 from(grids_[id].world_from_local[3]);
            grids_[id] = beam_at(from + 0.01 * (places[i] - 50.0), places[i].x);
            atlas_.move(id, grids_[id]);
        }
        for (const uint32_t probe : changed_) volume_.irradiance[probe] *= 1.01f;
        make_compact_probes(volume_);
        before_ = atlas_.texture();
        return seconds([&] { report_ = atlas_.refresh(volume_.view(), {.probes = changed_}); });
    }

    double refresh_everything() {
        return seconds([&] { atlas_.refresh(volume_.view(), {.is_everything = true}); });
    }

    /// Fraction of the volumes whose texels the last refresh changed.
    [[nodiscard]] double changed_fraction() const {
        size_t count = 0;
        for (uint32_t id = 0; id < grids_.size(); ++id) {
            const TexelBox box = atlas_.texels(id);
            bool is_changed = false;
            for (uint32_t i = 0; i < 64 && !is_changed; ++i) {
                const glm::uvec3 texel = box.min + 1u + glm::uvec3(i % 2, i / 2 % 2, i / 4);
                for (uint32_t slab = 0; slab < 4; ++slab) {
                    const glm::uvec3 at = texel + glm::uvec3(80 * slab, 0, 0);
                    is_changed |= fetch_texel(before_, at) != fetch_texel(atlas_.texture(), at);
                }
            }
            count += is_changed;
        }
        return static_cast<double>(count) / static_cast<double>(grids_.size());
    }

    [[nodiscard]] double refilled_fraction() const {
        return static_cast<double>(report_.refilled.size()) / static_cast<double>(grids_.size());
    }

    /// An atlas that is filled from scratch has the same bytes.
    void compare() const {
        LppvAtlas fresh({.slab_size = {80, 80, 144}});
        for (const LppvGrid& grid : grids_) {
            require(bool(fresh.add(grid, LppvQuality::Normal, LppvRefresh::Automatic)), "room");
        }
        fresh.refresh(volume_.view(), {});
        require(fresh.texture() == atlas_.texture(), "a refresh gives the bytes of a full one");
    }

  private:
    ProbeVolume volume_;
    LppvAtlas atlas_;
    std::vector<LppvGrid> grids_;
    std::vector<uint32_t> changed_;
    LppvTexture before_;
    LppvAtlasReport report_;
    uint64_t frame_ = 0;
};

void refresh(const Options& options) {
    Frames frames;
    std::vector<double> partial, full, fraction, refilled;
    for (int i = 0; i < 3 * options.repetitions; ++i) {
        partial.push_back(frames.refresh());
        fraction.push_back(frames.changed_fraction());
        refilled.push_back(frames.refilled_fraction());
        frames.compare();
        full.push_back(frames.refresh_everything());
        frames.compare();
    }
    report("lppv.refresh.changed_share", median(fraction), "of the volumes");
    report("lppv.refresh.refilled_share", median(refilled), "of the volumes");
    report("lppv.refresh.full", median(full) * 1e3, "ms");
    report("lppv.refresh", median(partial) / median(full) / median(fraction),
           "cost / full refresh / share changed");
}

#ifdef TETRALIGHT_HAS_OPENVDB
void write_vdb_file(const Subject& subject, const Options& options) {
    const std::string folder = std::filesystem::temp_directory_path().string();
    const std::string ours = folder + "/tetralight_bench.vdb";
    const std::string theirs = folder + "/tetralight_bench_openvdb.vdb";
    const Lppv lppv = *make_lppv(subject.volume.view(), grid_over(subject, 128), {});
    Contest contest;
    contest.figure = "lppv.write_vdb";
    contest.unit = "Mpoints/s";
    contest.baseline_is = "copyFromDense and openvdb::io::File, not synced";
    contest.work = static_cast<double>(lppv.irradiance.size()) * 1e-6;
    contest.ours = [&] {
        return seconds([&] { require(bool(write_vdb(ours, lppv, VdbPrecision::Float)), "write"); });
    };
    contest.baseline = [&] { return seconds([&] { write_vdb_by_openvdb(theirs, lppv); }); };
    run(contest, options);
    report("lppv.write_vdb.bytes", static_cast<double>(std::filesystem::file_size(ours)), "B");
    std::remove(ours.c_str());
    std::remove(theirs.c_str());
}
#endif

}  // namespace

void bench_lppv(const Options& options) {
    Subject subject = make_random_subject("20k", 20'000);
    fill(subject, 32, options);
    fill(subject, 128, options);
    refresh(options);
#ifdef TETRALIGHT_HAS_OPENVDB
    write_vdb_file(subject, options);
#endif
    bench_lppv_accuracy(options);
}

}  // namespace tetralight::bench
