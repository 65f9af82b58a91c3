// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/detail/hull_walk.h>

#include <tetralight/probes/detail/walk.h>

namespace tetralight::detail {
namespace {

class HullWalk {
  public:
    HullWalk(const ProbeVolumeView& volume, const QueryKernels& kernels, QueryBlock& block)
        : volume_(volume),
          kernels_(kernels),
          block_(block),
          unresolved_count_(block.unresolved_count) {
        block.unresolved_count = 0;
    }

    void run() {
        for (size_t lane = 0; lane < HullLanes::kCount; ++lane) begin_query(lane);
        while (active_count_ > 0) {
            kernels_.hull_weights(lanes_);
            block_.step_count += active_count_;
            for (size_t lane = 0; lane < HullLanes::kCount; ++lane) {
                if (walkers_[lane].cell != kNoIndex) end_step(lane);
            }
        }
    }

  private:
    struct Walker {
        uint32_t query = 0;
        uint32_t cell = kNoIndex;  ///< kNoIndex: the lane is idle
        uint32_t previous = kNoIndex;
        uint32_t steps = 0;
    };

    /// Takes the next unresolved query; those that are not in a hull cell stay unresolved.
    void begin_query(size_t lane) {
        while (next_ < unresolved_count_) {
            walkers_[lane] = {block_.unresolved[next_], block_.unresolved_cell[next_]};
            ++next_;
            if (load(lane)) {
                ++active_count_;
                return;
            }
            leave_unresolved(walkers_[lane]);
        }
        walkers_[lane] = {};
    }

    /// Puts a lane's hull cell, relative to its query, into the lanes. False if it is not a hull
    /// cell.
    bool load(size_t lane) {
        const Walker& walker = walkers_[lane];
        const uint32_t hull_index = walker.cell - volume_.info.inner_cell_count;
        if (walker.cell < volume_.info.inner_cell_count || walker.cell >= volume_.cells.size() ||
            hull_index >= volume_.hull_rays.size()) {
            return false;
        }
        const Cell& cell = volume_.cells[walker.cell];
        const HullCellRays& rays = volume_.hull_rays[hull_index];
        const glm::dvec3 query(block_.x[walker.query], block_.y[walker.query],
                               block_.z[walker.query]);
        for (size_t i = 0; i < 3; ++i) {
            if (cell.vertices[i] >= volume_.positions.size()) return false;
            const glm::dvec3 corner = glm::dvec3(volume_.positions[cell.vertices[i]]) - query;
            for (size_t axis = 0; axis < 3; ++axis) {
                const auto k = static_cast<int>(axis);
                lanes_.corners[i][axis][lane] = corner[k];
                lanes_.rays[i][axis][lane] = static_cast<double>(rays.rays[i][k]);
            }
        }
        return true;
    }

    void end_step(size_t lane) {
        Walker& walker = walkers_[lane];
        if (!lanes_.is_known[lane]) return end_query(lane, true);
        const CellWeights weights{
            {lanes_.weights[0][lane], lanes_.weights[1][lane], lanes_.weights[2][lane], 0.0}};
        if (weights.inside_measure() >= 0.0) {
            block_.location[walker.query] = finish(walker.cell, weights);
            return end_query(lane, false);
        }
        const uint32_t next = volume_.cells[walker.cell].neighbors[weights.most_negative()];
        const Walker before = walker;
        walker = {before.query, next, before.cell, before.steps + 1};
        if (next == before.previous || walker.steps == kWalkLimit || !load(lane)) {
            walker = before;
            end_query(lane, true);
        }
    }

    void end_query(size_t lane, bool is_unresolved) {
        if (is_unresolved) leave_unresolved(walkers_[lane]);
        --active_count_;
        begin_query(lane);
    }

    void leave_unresolved(const Walker& walker) {
        block_.unresolved[block_.unresolved_count] = walker.query;
        block_.unresolved_cell[block_.unresolved_count++] = walker.cell;
    }

    const ProbeVolumeView& volume_;
    const QueryKernels& kernels_;
    QueryBlock& block_;
    size_t unresolved_count_;
    size_t next_ = 0;
    size_t active_count_ = 0;
    std::array<Walker, HullLanes::kCount> walkers_;
    HullLanes lanes_{};
};

}  // namespace

void walk_hull(const ProbeVolumeView& volume, const QueryKernels& kernels, QueryBlock& block) {
    HullWalk(volume, kernels, block).run();
}

}  // namespace tetralight::detail
