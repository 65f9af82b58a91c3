// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/detail/grow_charts.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numeric>
#include <queue>

#include <tetralight/charts/detail/chart_layout.h>

namespace tetralight::detail {

namespace {

class ChartGrower {
  public:
    ChartGrower(const MeshTopology& mesh, double min_cosine)
        : mesh_(mesh),
          min_cosine_(min_cosine),
          is_taken_(mesh.triangles.size(), false),
          visit_of_(mesh.triangles.size(), 0),
          budget_(kBudgetPerTriangle * mesh.triangles.size()) {}

    [[nodiscard]] bool is_taken(uint32_t triangle) const { return is_taken_[triangle]; }

    /// The chart that contains `seed`. Its triangles are taken from now on.
    SurfaceChart grow(uint32_t seed) {
        SurfaceChart chart;
        chart.axis = settle_axis(seed);
        chart.triangles = collect(seed, chart.axis);
        for (const uint32_t triangle : chart.triangles) {
            is_taken_[triangle] = true;
            chart.area += mesh_.areas[triangle];
        }
        return chart;
    }

  private:
    struct Candidate {
        double distance;  ///< squared, from the seed: what lies close together stays together
        uint32_t triangle;

        bool operator>(const Candidate& other) const {
            return distance != other.distance ? distance > other.distance
                                              : triangle > other.triangle;
        }
    };

    [[nodiscard]] bool has_area(uint32_t triangle) const { return mesh_.areas[triangle] > 0.0; }

    [[nodiscard]] bool is_in_cone(uint32_t triangle, const glm::dvec3& axis) const {
        return !has_area(triangle) || glm::dot(mesh_.normals[triangle], axis) >= min_cosine_;
    }

    /// Marks a triangle as visited; true if it can join, and is visited for the first time.
    bool visit(uint32_t triangle, const glm::dvec3& axis) {
        if (is_taken_[triangle] || visit_of_[triangle] == visit_) return false;
        visit_of_[triangle] = visit_;
        return is_in_cone(triangle, axis);
    }

    /// Axis that is nearly the mean normal of the surface that it reaches from the seed.
    [[nodiscard]] glm::dvec3 settle_axis(uint32_t seed) {
        constexpr int kRounds = 6;
        constexpr double kSettled = 1.0 - 1e-12;
        if (!has_area(seed)) return any_axis(seed);
        glm::dvec3 axis = mesh_.normals[seed];
        for (int round = 0; round < kRounds; ++round) {
            if (budget_ == 0) break;
            const glm::dvec3 mean = mean_normal(seed, axis);
            if (glm::dot(mean, axis) > kSettled || !is_in_cone(seed, mean)) break;
            axis = mean;
        }
        return axis;
    }

    /// Mean normal of the triangles that can be reached in the cone about an axis, including those
    /// that overlap others.
    [[nodiscard]] glm::dvec3 mean_normal(uint32_t seed, const glm::dvec3& axis) {
        glm::dvec3 sum(0.0);
        ++visit_;
        visit(seed, axis);
        stack_.assign(1, seed);
        while (!stack_.empty()) {
            const uint32_t triangle = stack_.back();
            stack_.pop_back();
            budget_ -= std::min<uint64_t>(budget_, 1);
            sum += mesh_.areas[triangle] * mesh_.normals[triangle];
            mesh_.for_each_neighbor(triangle, [&](uint32_t other) {
                if (visit(other, axis)) stack_.push_back(other);
            });
        }
        return glm::normalize(sum);
    }

    /// A direction across a triangle without area, so that its extent is not lost.
    [[nodiscard]] glm::dvec3 any_axis(uint32_t triangle) const {
        const auto& [a, b, c] = mesh_.triangles[triangle];
        const glm::dvec3 ab = mesh_.points[b] - mesh_.points[a];
        const glm::dvec3 ac = mesh_.points[c] - mesh_.points[a];
        const glm::dvec3 along = glm::dot(ab, ab) > glm::dot(ac, ac) ? ab : ac;
        if (!(glm::dot(along, along) > 0.0)) return {0.0, 0.0, 1.0};
        return make_plane_frame(glm::normalize(along)).u;
    }

    [[nodiscard]] bool try_place(uint32_t triangle, const PlaneFrame& frame) {
        if (!has_area(triangle)) return true;
        const auto& [a, b, c] = mesh_.triangles[triangle];
        return layout_.try_add({frame.project(mesh_.points[a]), frame.project(mesh_.points[b]),
                                frame.project(mesh_.points[c])});
    }

    /// Triangles of the cone about an axis in order of their distance, without those that overlap.
    [[nodiscard]] std::vector<uint32_t> collect(uint32_t seed, const glm::dvec3& axis) {
        const PlaneFrame frame = make_plane_frame(axis);
        const glm::dvec3 origin = mesh_.center(seed);
        std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue;
        const auto offer = [&](uint32_t triangle) {
            if (!visit(triangle, axis)) return;
            const glm::dvec3 offset = mesh_.center(triangle) - origin;
            queue.push({glm::dot(offset, offset), triangle});
        };
        std::vector<uint32_t> triangles;
        ++visit_;
        layout_.clear();
        for (offer(seed); !queue.empty();) {
            const uint32_t triangle = queue.top().triangle;
            queue.pop();
            if (!try_place(triangle, frame)) continue;
            triangles.push_back(triangle);
            mesh_.for_each_neighbor(triangle, offer);
        }
        return triangles;
    }

    /// Where much overlaps, an axis sees much that its chart cannot have. The time for all axes is
    /// linear in the size of the mesh; when it is used up, charts keep the normal of their seed.
    static constexpr uint64_t kBudgetPerTriangle = 100;

    const MeshTopology& mesh_;
    double min_cosine_;
    std::vector<bool> is_taken_;
    std::vector<uint32_t> visit_of_;  ///< last visit of each triangle
    uint32_t visit_ = 0;
    uint64_t budget_;  ///< triangles that may still be visited to settle axes
    std::vector<uint32_t> stack_;
    ChartLayout layout_;
};

/// Large triangles first. Those of nearly the same size stay in their order, in which neighbors are
/// often near each other: a chart that starts beside another leaves no gap.
std::vector<uint32_t> seed_order(const MeshTopology& mesh) {
    std::vector<uint32_t> order(mesh.triangles.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto size_class = [&](uint32_t t) { return std::ilogb(std::sqrt(mesh.areas[t])); };
    std::ranges::stable_sort(order, std::greater<>(), size_class);
    return order;
}

}  // namespace

std::vector<SurfaceChart> grow_charts(const MeshTopology& mesh, double min_cosine) {
    std::vector<SurfaceChart> charts;
    ChartGrower grower(mesh, min_cosine);
    for (const uint32_t seed : seed_order(mesh)) {
        if (!grower.is_taken(seed)) charts.push_back(grower.grow(seed));
    }
    return charts;
}

}  // namespace tetralight::detail
