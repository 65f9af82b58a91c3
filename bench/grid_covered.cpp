// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/grid_covered.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <tetralight/bake/parallel.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/probes/locate.h>

namespace tetralight::bench {
namespace {

/// What the corners that a covered place sees weigh together, at least.
constexpr float kLeastSeen = 0.25f;

enum class Place : uint8_t { TooClose, Covered, InHullCell, Unseen };

class CoverTest {
  public:
    CoverTest(const TraceScene& traced, const BakedGrid& grid) : traced_(traced), grid_(grid) {}

    [[nodiscard]] Place operator()(glm::vec3 position) const {
        constexpr double kMargin = 0.01;
        const glm::vec3 here = traced_.render_from_world(glm::dvec3(position));
        const auto surface = traced_.nearest_surface(here);
        if (surface && double{glm::distance(*surface, here)} < grid_.clearance + kMargin) {
            return Place::TooClose;
        }
        const CellLocation location = locate(grid_.volume, position);
        if (location.cell >= grid_.volume.info.inner_cell_count) return Place::InHullCell;
        return seen_weight(here, location) >= kLeastSeen ? Place::Covered : Place::Unseen;
    }

  private:
    [[nodiscard]] float seen_weight(glm::vec3 here, const CellLocation& location) const {
        const Cell& cell = grid_.volume.cells[location.cell];
        float sum = 0.0f;
        for (int i = 0; i < 4; ++i) {
            if (!(location.weights[i] > 0.0f)) continue;
            const glm::vec3 probe =
                traced_.render_from_world(grid_.volume.exact_positions[cell.vertices[i]]);
            const bool is_seen = here == probe || !traced_.occluded({here, probe - here, 1.0f});
            sum += is_seen ? location.weights[i] : 0.0f;
        }
        return sum;
    }

    const TraceScene& traced_;
    const BakedGrid& grid_;
};

}  // namespace

void report_cover(const BakedGrid& grid, const LightReference& places) {
    const auto traced = TraceScene::make_static(grid.subject.scene);
    require(bool(traced), "scene");
    const CoverTest test(*traced, grid);
    std::vector<Place> kinds(places.positions.size());
    parallel_for(kinds.size(), 0, [&](size_t i) { kinds[i] = test(places.positions[i]); });
    const auto count_of = [&](Place kind) {
        return static_cast<double>(std::ranges::count(kinds, kind));
    };
    const double all = static_cast<double>(kinds.size()) - count_of(Place::TooClose);
    const std::string unit =
        str_cat("% of ", all, " places, ", grid.volume.probe_count(), " probes");
    const auto report_share = [&](const char* figure, Place kind) {
        report(str_cat("grid.", figure, ".", grid.subject.name, ".", grid.name),
               100.0 * count_of(kind) / all, unit);
    };
    report_share("covered", Place::Covered);
    report_share("hull_cells", Place::InHullCell);
    report_share("unseen", Place::Unseen);
}

void report_unlit(const BakedGrid& grid) {
    const auto unlit =
        static_cast<double>(std::ranges::count(grid.volume.irradiance, IrradianceSh{}));
    const uint32_t count = grid.volume.probe_count();
    report(str_cat("grid.unlit.", grid.subject.name, ".", grid.name), 100.0 * unlit / count,
           str_cat("% of ", count, " probes"));
}

}  // namespace tetralight::bench
