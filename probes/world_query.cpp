// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/world_query.h>

#include <algorithm>
#include <vector>

#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/query_output.h>
#include <tetralight/probes/uniform_receiver.h>

namespace tetralight {
namespace {

/// Answers positions tile by tile.
class WorldQuery {
  public:
    WorldQuery(const WorldTiles& tiles, const WorldBatch& batch)
        : tiles_(tiles), index_(tiles.index()), batch_(batch) {}

    Result<WorldReport> run() {
        if (auto status = check_lengths(); !status) return status.error();
        sort_by_tile();
        size_t begin = 0;
        while (begin < order_.size()) {
            const uint32_t tile = order_[begin].place.tile;
            size_t end = begin;
            while (end < order_.size() && order_[end].place.tile == tile) ++end;
            const auto part = std::span(order_).subspan(begin, end - begin);
            if (auto status = answer_part(tile, part); !status) return status.error();
            begin = end;
        }
        return report_;
    }

  private:
    struct Query {
        WorldPlace place;
        uint32_t position = 0;
    };

    /// One position with the cell where its walk begins.
    struct Start {
        uint32_t position = 0;
        uint32_t cell = 0;
    };

    [[nodiscard]] Status check_lengths() const {
        const size_t count = batch_.positions.size();
        const auto is_long_enough = [&](const char* name, size_t length) {
            return length == 0 ? Status(Ok{}) : check_length(name, length, count);
        };
        for (const Status& status : {is_long_enough("irradiance", batch_.irradiance.size()),
                                     is_long_enough("occlusion", batch_.occlusion.size()),
                                     is_long_enough("states", batch_.states.size()),
                                     is_long_enough("locations", batch_.locations.size())}) {
            if (!status) return status;
        }
        return Ok{};
    }

    void sort_by_tile() {
        order_.resize(batch_.positions.size());
        for (uint32_t i = 0; i < order_.size(); ++i) {
            order_[i] = {find_place(index_, batch_.positions[i]), i};
        }
        std::ranges::stable_sort(order_, {}, [](const Query& query) { return query.place.tile; });
    }

    [[nodiscard]] Status answer_part(uint32_t tile, std::span<const Query> part) {
        if (tile == kNoIndex || !tiles_.is_open(tile)) {
            const auto state = tile == kNoIndex ? WorldState::NotFinite : WorldState::Closed;
            for (const Query& query : part) refuse(query.position, tile, state);
            return Ok{};
        }
        const ProbeVolumeView& volume = tiles_.find(tile)->view();
        std::vector<Start> starts;
        starts.reserve(part.size());
        for (const Query& query : part) {
            starts.push_back({query.position, start_cell(volume, query.place)});
        }
        const bool is_outside = tile + 1 == index_.tiles.size();
        if (is_outside || batch_.outside.policy == OutsidePolicy::Extrapolate) {
            return answer(tile, starts, batch_.outside);
        }
        if (auto status = answer(tile, starts, {}); !status) return status;
        return answer_outside(tile, starts);
    }

    /// Answers those of a tile that are outside the hull again, in the tile that has all of it.
    [[nodiscard]] Status answer_outside(uint32_t tile, std::span<const Start> starts) {
        const uint32_t inner_count = index_.tiles[tile].inner_cell_count;
        const auto outside = static_cast<uint32_t>(index_.tiles.size() - 1);
        const auto cells = tiles_.volume_cells(tile);
        std::vector<Start> again;
        for (size_t i = 0; i < starts.size(); ++i) {
            const uint32_t cell = locations_[i].cell;
            if (cell < inner_count || cell >= index_.tiles[tile].cell_count) continue;
            if (!tiles_.is_open(outside) || cell >= cells.size()) {
                refuse(starts[i].position, outside, WorldState::Closed);
                continue;
            }
            const uint32_t hull_index = cells[cell] - index_.info.inner_cell_count;
            again.push_back(
                {starts[i].position, index_.tiles[outside].inner_cell_count + hull_index});
        }
        return again.empty() ? Status(Ok{}) : answer(outside, again, batch_.outside);
    }

    [[nodiscard]] Status answer(uint32_t tile, std::span<const Start> starts,
                                const OutsideHull& outside) {
        const size_t count = starts.size();
        positions_.resize(count);
        hints_.resize(count);
        irradiance_.resize(count);
        occlusion_.resize(count);
        locations_.resize(count);
        for (size_t i = 0; i < count; ++i) {
            positions_[i] = batch_.positions[starts[i].position];
            hints_[i] = starts[i].cell;
        }
        const ProbeVolumeView& stored = tiles_.find(tile)->view();
        const bool is_full = batch_.precision == WorldBatch::Precision::Full;
        const ProbeVolumeView volume = is_full ? stored.without_compact() : stored;
        InterpolationBatch batch;
        batch.positions = positions_;
        batch.hints = hints_;
        batch.irradiance = irradiance_;
        batch.occlusion = occlusion_;
        batch.outside = outside;
        batch.locations = locations_;
        receiver_.set(batch_.receiver, batch);
        const auto report = interpolate(volume, batch);
        if (!report) return report.error();
        for (size_t i = 0; i < count; ++i) {
            if (locations_[i].cell >= index_.tiles[tile].cell_count) {
                refuse(starts[i].position, tile, WorldState::Lost);
            } else {
                store(starts[i].position, {tile, locations_[i]}, irradiance_[i], occlusion_[i]);
            }
        }
        return Ok{};
    }

    void refuse(uint32_t position, uint32_t tile, WorldState state) {
        store(position, {tile, {}}, index_.info.ambient, glm::vec4(1.0f));
        if (!batch_.states.empty()) batch_.states[position] = state;
        report_.not_finite_count += state == WorldState::NotFinite;
        report_.closed_count += state == WorldState::Closed;
        report_.lost_count += state == WorldState::Lost;
    }

    void store(uint32_t position, const WorldLocation& location, const IrradianceSh& irradiance,
               const glm::vec4& occlusion) {
        if (!batch_.irradiance.empty()) batch_.irradiance[position] = irradiance;
        if (!batch_.occlusion.empty()) batch_.occlusion[position] = occlusion;
        if (!batch_.locations.empty()) batch_.locations[position] = location;
        if (!batch_.states.empty()) batch_.states[position] = WorldState::Answered;
    }

    const WorldTiles& tiles_;
    WorldIndexView index_;
    const WorldBatch& batch_;
    WorldReport report_;
    std::vector<Query> order_;
    std::vector<glm::vec3> positions_;
    std::vector<uint32_t> hints_;
    std::vector<IrradianceSh> irradiance_;
    std::vector<glm::vec4> occlusion_;
    std::vector<CellLocation> locations_;
    UniformReceiver receiver_;
};

}  // namespace

Result<WorldReport> interpolate(const WorldTiles& tiles, const WorldBatch& batch) {
    return WorldQuery(tiles, batch).run();
}

std::vector<uint32_t> tiles_of(const WorldIndexView& index, std::span<const glm::vec3> positions) {
    std::vector<bool> is_needed(index.tiles.size(), false);
    for (const glm::vec3& position : positions) {
        const uint32_t tile = find_place(index, position).tile;
        if (tile != kNoIndex) is_needed[tile] = true;
    }
    std::vector<uint32_t> tiles;
    for (uint32_t tile = 0; tile < is_needed.size(); ++tile) {
        if (is_needed[tile]) tiles.push_back(tile);
    }
    return tiles;
}

}  // namespace tetralight
