// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/free_places.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include <tetralight/bake/blocked_fraction.h>
#include <tetralight/bake/parallel.h>
#include <tetralight/bake/placement/coverage.h>
#include <tetralight/bake/probe_visibility.h>
#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/base/box.h>
#include <tetralight/base/contract.h>
#include <tetralight/probes/build/probe_edges.h>

namespace tetralight {
namespace {

/// Positions that are tested between two looks at how many are free.
constexpr uint64_t kBlockSize = 1024;
constexpr size_t kNearestCount = 16;
/// Metres around a probe that has no neighbor.
constexpr float kReachWithoutEdges = 1.0f;

float median_edge_length(const ProbeVolumeView& volume) {
    const ProbeEdges edges(volume);
    std::vector<float> lengths;
    lengths.reserve(edges.size() / 2);
    for (uint32_t from = 0; from < volume.probe_count(); ++from) {
        for (const uint32_t to : edges.targets(from)) {
            if (to < from) continue;
            lengths.push_back(glm::distance(volume.positions[from], volume.positions[to]));
        }
    }
    if (lengths.empty()) return 0.0f;
    const auto median = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::ranges::nth_element(lengths, median);
    return *median;
}

/// The box of the probes and half a spacing more, world space.
Box<glm::dvec3> region_of(const ProbeVolumeView& volume, float spacing) {
    auto box = Box<glm::vec3>::empty();
    for (const glm::vec3& position : volume.positions) box = union_of(box, position);
    const glm::dvec3 reach(spacing > 0.0f ? 0.5f * spacing : kReachWithoutEdges);
    return {volume.info.world_origin + glm::dvec3(box.min) - reach,
            volume.info.world_origin + glm::dvec3(box.max) + reach};
}

class PlaceSearch {
  public:
    PlaceSearch(const TraceScene& traced, const ProbeEyes& eyes, const ProbeVolumeView& volume,
                const FreePlaceSettings& settings, const Box<glm::dvec3>& region)
        : traced_(traced), eyes_(eyes), volume_(volume), settings_(settings), region_(region) {}

    /// The place of one draw, if it is free and the volume is to light it.
    [[nodiscard]] std::optional<FreePlace> draw(uint64_t index) const {
        RandomStream random(settings_.seed, index);
        const double x = random.next(), y = random.next(), z = random.next();
        FreePlace place;
        place.position = glm::vec3(glm::mix(region_.min, region_.max, glm::dvec3(x, y, z)));
        const glm::vec3 position = traced_.render_from_world(glm::dvec3(place.position));
        if (is_near_surface(position)) return std::nullopt;
        place.location = locate(volume_, place.position);
        if (place.location.cell == kNoIndex) return std::nullopt;
        const bool is_known_free = look_from_corners(position, place);
        if (is_known_free) return place;
        if (!is_between_probes(place) && place.is_unseen()) {
            const auto sight = sight_of_nearest(position);
            if (sight == Sight::OfFreeProbe) return place;
            if (sight == Sight::None) return std::nullopt;
        }
        if (probe_visibility(traced_, position).is_inside(settings_.min_validity)) {
            return std::nullopt;
        }
        return place;
    }

  private:
    enum class Sight : uint8_t { None, OfInsideProbe, OfFreeProbe };

    [[nodiscard]] bool is_near_surface(glm::vec3 position) const {
        const auto nearest = traced_.nearest_surface(position);
        return nearest && glm::distance(position, *nearest) < settings_.clearance;
    }

    [[nodiscard]] bool sees(uint32_t probe, glm::vec3 position) const {
        const glm::vec3 eye = eyes_.positions[probe];
        return eye == position || !blocked_fraction(traced_, eye, position);
    }

    /// Fills `is_seen`. True if a probe that is not inside geometry sees the place: no surface is
    /// between them, so the place is not inside geometry either.
    [[nodiscard]] bool look_from_corners(glm::vec3 position, FreePlace& place) const {
        bool is_known_free = false;
        const Cell& cell = volume_.cells[place.location.cell];
        for (int i = 0; i < 4; ++i) {
            const uint32_t probe = cell.vertices[static_cast<size_t>(i)];
            if (!(place.location.weights[i] > 0.0f) || probe >= volume_.probe_count()) continue;
            const bool is_seen = sees(probe, position);
            place.is_seen[static_cast<size_t>(i)] = is_seen;
            is_known_free = is_known_free || (is_seen && eyes_.is_inside[probe] == 0);
        }
        return is_known_free;
    }

    [[nodiscard]] bool is_between_probes(const FreePlace& place) const {
        return volume_.info.dimension == Dimension::Space &&
               place.location.cell < volume_.info.inner_cell_count;
    }

    [[nodiscard]] Sight sight_of_nearest(glm::vec3 position) const {
        Sight sight = Sight::None;
        for (const uint32_t probe : nearest_probes(position)) {
            if (!sees(probe, position)) continue;
            if (eyes_.is_inside[probe] == 0) return Sight::OfFreeProbe;
            sight = Sight::OfInsideProbe;
        }
        return sight;
    }

    [[nodiscard]] std::vector<uint32_t> nearest_probes(glm::vec3 position) const {
        using Near = std::pair<float, uint32_t>;
        std::vector<Near> nearest;  // a heap: the farthest first
        for (uint32_t i = 0; i < eyes_.positions.size(); ++i) {
            const glm::vec3 way = eyes_.positions[i] - position;
            const Near candidate{glm::dot(way, way), i};
            if (nearest.size() == kNearestCount) {
                if (!(candidate < nearest.front())) continue;
                std::ranges::pop_heap(nearest);
                nearest.pop_back();
            }
            nearest.push_back(candidate);
            std::ranges::push_heap(nearest);
        }
        std::ranges::sort(nearest);
        std::vector<uint32_t> probes;
        for (const Near& near : nearest) probes.push_back(near.second);
        return probes;
    }

    const TraceScene& traced_;
    const ProbeEyes& eyes_;
    const ProbeVolumeView& volume_;
    const FreePlaceSettings& settings_;
    Box<glm::dvec3> region_;
};

}  // namespace

ProbeEyes make_probe_eyes(const TraceScene& traced, const ProbeVolumeView& volume,
                          float min_validity, uint32_t thread_count) {
    ProbeEyes eyes;
    const size_t count = volume.positions.size();
    for (uint32_t i = 0; i < count; ++i) {
        eyes.positions.push_back(probe_eye(traced, volume, i));
    }
    eyes.is_inside.assign(count, 0);
    parallel_for(count, thread_count, [&](size_t i) {
        eyes.is_inside[i] = probe_visibility(traced, eyes.positions[i]).is_inside(min_validity);
    });
    return eyes;
}

FreePlaces find_free_places(const TraceScene& traced, const ProbeEyes& eyes,
                            const ProbeVolumeView& volume, const FreePlaceSettings& settings) {
    TETRALIGHT_ASSERT(eyes.positions.size() == volume.positions.size(), "one a probe");
    FreePlaces found;
    if (volume.positions.empty() || volume.cells.empty()) return found;
    found.spacing = median_edge_length(volume);
    const PlaceSearch search(traced, eyes, volume, settings, region_of(volume, found.spacing));
    const uint64_t most = uint64_t{settings.most_draws} * settings.count;
    std::vector<std::optional<FreePlace>> block;
    while (found.places.size() < settings.count && found.drawn_count < most) {
        block.assign(std::min(kBlockSize, most - found.drawn_count), std::nullopt);
        parallel_for(block.size(), settings.thread_count,
                     [&](size_t i) { block[i] = search.draw(found.drawn_count + i); });
        for (const auto& place : block) {
            if (found.places.size() == settings.count) break;
            ++found.drawn_count;
            if (place) found.places.push_back(*place);
        }
    }
    return found;
}

}  // namespace tetralight
