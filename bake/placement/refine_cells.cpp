// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/refine_cells.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include <tetralight/bake/parallel.h>
#include <tetralight/bake/placement/cell_lists.h>
#include <tetralight/base/contract.h>

namespace tetralight {
namespace {

/// Cells that are looked at for each new probe, and sensors that are tried in each.
constexpr size_t kCellsPerProbe = 2, kMinCells = 32, kTrialsPerCell = 3;
/// Minimum distance between new probes, as a fraction of the distance to their cell's corners.
constexpr double kDistanceFraction = 0.5;

/// A sensor of a cell and what it would save as a probe.
struct Offer {
    uint32_t sensor = kNoIndex;  ///< in the pool
    double gain = 0.0;
    double room = 0.0;  ///< metres to the nearest corner of its cell
};

class Refiner {
  public:
    Refiner(const RefineInput& input, const RefineRule& rule)
        : input_(input),
          rule_(rule),
          cells_(cells_of_probes(input.volume)),
          sensors_(sensors_of_cells(input.volume, input.errors)) {}

    std::vector<uint32_t> run() {
        const std::vector<uint32_t> cells = costly_cells();
        std::vector<Offer> offers(cells.size());
        parallel_for(cells.size(), rule_.thread_count,
                     [&](size_t i) { offers[i] = best_offer(cells[i]); });
        std::ranges::stable_sort(offers, std::greater{}, &Offer::gain);
        std::vector<Offer> chosen;
        for (const Offer& offer : offers) {
            if (chosen.size() == rule_.max_count || !(offer.gain > 0.0)) break;
            if (is_apart(offer, chosen)) chosen.push_back(offer);
        }
        std::vector<uint32_t> found;
        for (const Offer& offer : chosen) found.push_back(offer.sensor);
        return found;
    }

  private:
    [[nodiscard]] double cost_in(uint32_t cell) const {
        double sum = 0.0;
        for (const uint32_t i : sensors_[cell]) sum += input_.errors[i].cost();
        return sum;
    }

    /// The cells with costs that have a sensor which may become a probe, the largest costs first.
    [[nodiscard]] std::vector<uint32_t> costly_cells() const {
        const size_t most = std::max(kCellsPerProbe * rule_.max_count, kMinCells);
        std::vector<double> costs(sensors_.size());
        std::vector<uint32_t> cells;
        for (uint32_t c = 0; c < sensors_.size(); ++c) {
            costs[c] = cost_in(c);
            if (costs[c] > 0.0) cells.push_back(c);
        }
        std::ranges::stable_sort(cells, std::greater{}, [&](uint32_t c) { return costs[c]; });
        std::vector<uint32_t> found;
        for (const uint32_t cell : cells) {
            if (found.size() == most) break;
            if (!candidates_in(cell).empty()) found.push_back(cell);
        }
        return found;
    }

    /// Sensors that may become probes: the one that costs most, and others at even ranks.
    [[nodiscard]] std::vector<uint32_t> candidates_in(uint32_t cell) const {
        std::vector<uint32_t> ranked = sensors_[cell];
        std::ranges::stable_sort(ranked, std::greater{},
                                 [&](uint32_t i) { return input_.errors[i].cost(); });
        std::vector<uint32_t> candidates;
        for (const uint32_t i : ranked) {
            const uint32_t sensor = input_.sensors[i];
            if (room_of(cell, sensor) > rule_.clearance && rule_.may_become_probe(sensor)) {
                candidates.push_back(sensor);
            }
        }
        if (candidates.size() <= kTrialsPerCell) return candidates;
        std::vector<uint32_t> some;
        for (size_t k = 0; k < kTrialsPerCell; ++k) {
            some.push_back(candidates[k * candidates.size() / kTrialsPerCell]);
        }
        return some;
    }

    /// Metres to the nearest corner.
    [[nodiscard]] double room_of(uint32_t cell, uint32_t sensor) const {
        double room = std::numeric_limits<double>::infinity();
        for (const uint32_t probe : input_.volume.cells[cell].vertices) {
            if (probe == kNoIndex) continue;
            room = std::min(room, glm::distance(input_.view.pool.position(sensor),
                                                input_.volume.exact_positions[probe]));
        }
        return room;
    }

    /// True if two cells have two corners or more in common: a probe in one changes the light of
    /// such cells most.
    [[nodiscard]] bool shares_edge(uint32_t a, uint32_t b) const {
        const auto& others = input_.volume.cells[b].vertices;
        return std::ranges::count_if(input_.volume.cells[a].vertices, [&](uint32_t probe) {
                   return probe != kNoIndex && std::ranges::find(others, probe) != others.end();
               }) >= 2;
    }

    [[nodiscard]] Offer best_offer(uint32_t cell) const {
        std::vector<uint32_t> around;
        for (const uint32_t probe : input_.volume.cells[cell].vertices) {
            if (probe == kNoIndex) continue;
            around.insert(around.end(), cells_[probe].begin(), cells_[probe].end());
        }
        std::ranges::sort(around);
        around.erase(std::ranges::unique(around).begin(), around.end());
        std::vector<uint32_t> probes = named(probes_of_cells(input_.volume, around), input_.probes);
        std::vector<uint32_t> sensors;
        for (const uint32_t c : around) {
            if (!shares_edge(cell, c)) continue;
            for (const uint32_t i : sensors_[c]) sensors.push_back(input_.sensors[i]);
        }
        const double before = cost_by(probes, sensors);
        Offer best;
        probes.push_back(kNoIndex);
        for (const uint32_t candidate : candidates_in(cell)) {
            probes.back() = candidate;
            const double gain = before - cost_by(probes, sensors);
            if (gain > best.gain) best = {candidate, gain, room_of(cell, candidate)};
        }
        return best;
    }

    [[nodiscard]] double cost_by(const std::vector<uint32_t>& probes,
                                 const std::vector<uint32_t>& sensors) const {
        const ProbeVolume volume = volume_of(input_.view.pool, probes);
        return sum_of_costs(sensor_errors(volume, probes, sensors, input_.view, 1));
    }

    [[nodiscard]] bool is_apart(const Offer& offer, const std::vector<Offer>& chosen) const {
        const LightPool& pool = input_.view.pool;
        return std::ranges::none_of(chosen, [&](const Offer& other) {
            const double least = kDistanceFraction * std::min(offer.room, other.room);
            return glm::distance(pool.position(offer.sensor), pool.position(other.sensor)) < least;
        });
    }

    const RefineInput& input_;
    const RefineRule& rule_;
    Lists cells_, sensors_;
};

}  // namespace

std::vector<uint32_t> refine_cells(const RefineInput& input, const RefineRule& rule) {
    TETRALIGHT_ASSERT(input.errors.size() == input.sensors.size(), "one error for each sensor");
    return Refiner(input, rule).run();
}

}  // namespace tetralight
