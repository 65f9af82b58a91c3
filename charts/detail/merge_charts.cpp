// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/detail/merge_charts.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <tetralight/charts/detail/chart_layout.h>
#include <tetralight/charts/detail/cone_axis.h>
#include <tetralight/charts/detail/support_normals.h>

namespace tetralight::detail {

namespace {

class ChartMerger {
  public:
    ChartMerger(const MeshTopology& mesh, std::vector<SurfaceChart> charts, double min_cosine)
        : mesh_(mesh),
          charts_(std::move(charts)),
          min_cosine_(min_cosine),
          chart_of_(mesh.triangles.size()),
          borders_(charts_.size()),
          support_normals_(charts_.size()),
          budget_(kBudgetPerTriangle * mesh.triangles.size()) {
        for (uint32_t c = 0; c < charts_.size(); ++c) {
            for (const uint32_t triangle : charts_[c].triangles) {
                chart_of_[triangle] = c;
                support_normals_[c].add(mesh.normals[triangle]);
            }
        }
        for (uint32_t edge = 0; edge < mesh.edge_uses.size(); ++edge) add_border(edge);
    }

    std::vector<SurfaceChart> merge() {
        std::set<Waiting> waiting;
        for (uint32_t c = 0; c < charts_.size(); ++c) waiting.insert({charts_[c].area, c});
        while (!waiting.empty()) {
            const uint32_t chart = waiting.begin()->chart;
            waiting.erase(waiting.begin());
            const uint32_t target = merge_into_neighbor(chart);
            if (target == chart) continue;
            // The target may have waited, with its area so far, or may have been done.
            waiting.erase({charts_[target].area, target});
            absorb(chart, target);
            waiting.insert({charts_[target].area, target});
        }
        std::erase_if(charts_, [](const SurfaceChart& chart) { return chart.triangles.empty(); });
        return std::move(charts_);
    }

  private:
    struct Waiting {
        double area;
        uint32_t chart;

        auto operator<=>(const Waiting&) const = default;
    };

    void add_border(uint32_t edge) {
        const uint32_t triangle = edge / 3;
        const auto& corners = mesh_.triangles[triangle];
        const double length =
            glm::distance(mesh_.points[corners[edge % 3]], mesh_.points[corners[(edge + 1) % 3]]);
        mesh_.for_each_neighbor_edge(edge, [&](uint32_t other) {
            const uint32_t a = chart_of_[triangle], b = chart_of_[other / 3];
            if (a == b) return;
            borders_[a][b] += length;
            borders_[b][a] += length;
        });
    }

    /// The neighbor with the longest common border that can take a chart, with `merged_axis_` for
    /// both; the chart itself if there is none.
    uint32_t merge_into_neighbor(uint32_t chart) {
        std::vector<std::pair<double, uint32_t>> neighbors;
        for (const auto& [other, length] : borders_[chart]) neighbors.emplace_back(-length, other);
        std::ranges::sort(neighbors);
        for (const auto& [length, other] : neighbors) {
            if (can_merge(chart, other)) return other;
        }
        return chart;
    }

    /// True if one axis is right for two charts; it is in `merged_axis_` then.
    [[nodiscard]] bool can_merge(uint32_t a, uint32_t b) {
        const std::optional<glm::dvec3> guess = support_axis(a, b);
        const uint64_t count = charts_[a].triangles.size() + charts_[b].triangles.size();
        if (!guess || (budget_ == 0 && count > kSmallMerge)) return false;
        if (count > kSmallMerge) budget_ -= std::min(budget_, count);
        return find_axis(charts_[a], charts_[b], *guess) && can_place_both(charts_[a], charts_[b]);
    }

    /// An axis for the support normals of two charts: a first test that takes constant time.
    [[nodiscard]] std::optional<glm::dvec3> support_axis(uint32_t a, uint32_t b) {
        const glm::dvec3 sum =
            charts_[a].area * charts_[a].axis + charts_[b].area * charts_[b].axis;
        const double length = glm::length(sum);
        normals_.clear();
        for (const uint32_t chart : {a, b}) {
            const auto& normals = support_normals_[chart].normals();
            normals_.insert(normals_.end(), normals.begin(), normals.end());
        }
        return find_cone_axis(normals_, length > 0.0 ? sum / length : charts_[b].axis, min_cosine_);
    }

    [[nodiscard]] bool find_axis(const SurfaceChart& a, const SurfaceChart& b, glm::dvec3 guess) {
        normals_.clear();
        for (const uint32_t triangle : a.triangles) normals_.push_back(mesh_.normals[triangle]);
        for (const uint32_t triangle : b.triangles) normals_.push_back(mesh_.normals[triangle]);
        const std::optional<glm::dvec3> axis = find_cone_axis(normals_, guess, min_cosine_);
        if (axis) merged_axis_ = *axis;
        return axis.has_value();
    }

    [[nodiscard]] bool can_place_both(const SurfaceChart& a, const SurfaceChart& b) {
        const PlaneFrame frame = make_plane_frame(merged_axis_);
        layout_.clear();
        return can_place(a, frame) && can_place(b, frame);
    }

    [[nodiscard]] bool can_place(const SurfaceChart& chart, const PlaneFrame& frame) {
        return std::ranges::all_of(chart.triangles, [&](uint32_t triangle) {
            if (!(mesh_.areas[triangle] > 0.0)) return true;
            const auto& [a, b, c] = mesh_.triangles[triangle];
            return layout_.try_add({frame.project(mesh_.points[a]), frame.project(mesh_.points[b]),
                                    frame.project(mesh_.points[c])});
        });
    }

    void absorb(uint32_t chart, uint32_t target) {
        SurfaceChart& from = charts_[chart];
        SurfaceChart& into = charts_[target];
        into.axis = merged_axis_;
        into.area += from.area;
        into.triangles.insert(into.triangles.end(), from.triangles.begin(), from.triangles.end());
        from = {};
        support_normals_[target].add(support_normals_[chart]);
        for (const auto& [other, length] : borders_[chart]) {
            borders_[other].erase(chart);
            if (other == target) continue;
            borders_[other][target] += length;
            borders_[target][other] += length;
        }
        borders_[chart].clear();
    }

    /// Small charts may try to merge at any time. All attempts of larger ones together take a time
    /// that is linear in the size of the mesh.
    static constexpr uint64_t kSmallMerge = 256;
    static constexpr uint64_t kBudgetPerTriangle = 16;

    const MeshTopology& mesh_;
    std::vector<SurfaceChart> charts_;
    double min_cosine_;
    std::vector<uint32_t> chart_of_;                   ///< before anything is merged
    std::vector<std::map<uint32_t, double>> borders_;  ///< length of the border with each neighbor
    std::vector<SupportNormals> support_normals_;
    uint64_t budget_;  ///< triangles that attempts of large charts may still look at
    std::vector<glm::dvec3> normals_;
    glm::dvec3 merged_axis_{};
    ChartLayout layout_;
};

}  // namespace

std::vector<SurfaceChart> merge_charts(const MeshTopology& mesh, std::vector<SurfaceChart> charts,
                                       double min_cosine) {
    return ChartMerger(mesh, std::move(charts), min_cosine).merge();
}

}  // namespace tetralight::detail
