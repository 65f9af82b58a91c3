// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/closed_solids.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <tuple>

#include <tetralight/bake/probe_visibility.h>

namespace tetralight::bench {
namespace {

/// Groups the triangles of a mesh that share edges.
class Edges {
  public:
    Edges(const TraceScene& traced, uint32_t geometry) : part_of_(traced.triangle_count(geometry)) {
        std::iota(part_of_.begin(), part_of_.end(), 0u);
        for (uint32_t p = 0; p < part_of_.size(); ++p) {
            const auto corners = traced.triangle(geometry, p);
            for (int i = 0; i < 3; ++i) add(p, number(corners[i]), number(corners[(i + 1) % 3]));
        }
        is_open_.resize(part_of_.size(), false);
        for (const auto& [ends, edge] : edges_) {
            if (edge.balance != 0) is_open_[part_of(edge.triangle)] = true;
        }
    }

    /// The part that a triangle belongs to.
    [[nodiscard]] uint32_t part_of(uint32_t triangle) {
        while (part_of_[triangle] != triangle) {
            triangle = part_of_[triangle] = part_of_[part_of_[triangle]];
        }
        return triangle;
    }

    [[nodiscard]] bool is_open(uint32_t part) const { return is_open_[part]; }

  private:
    /// Each edge occurs equally often in both directions if the surface is closed.
    struct Edge {
        uint32_t triangle = 0;
        int balance = 0;
    };

    uint32_t number(const glm::vec3& corner) {
        const auto next = static_cast<uint32_t>(numbers_.size());
        return numbers_.try_emplace({corner.x, corner.y, corner.z}, next).first->second;
    }

    void add(uint32_t triangle, uint32_t from, uint32_t to) {
        if (from == to) return;
        Edge& edge = edges_.try_emplace({std::min(from, to), std::max(from, to)}, Edge{triangle, 0})
                         .first->second;
        edge.balance += from < to ? 1 : -1;
        const uint32_t a = part_of(triangle), b = part_of(edge.triangle);
        part_of_[std::max(a, b)] = std::min(a, b);
    }

    std::map<std::tuple<float, float, float>, uint32_t> numbers_;
    std::map<std::pair<uint32_t, uint32_t>, Edge> edges_;
    std::vector<uint32_t> part_of_;
    std::vector<bool> is_open_;
};

}  // namespace

double solid_angle(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& position) {
    const glm::dvec3 a = corners[0] - position, b = corners[1] - position,
                     c = corners[2] - position;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const double volume = glm::dot(a, glm::cross(b, c));
    const double rest =
        la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
    return 2.0 * std::atan2(volume, rest);
}

ClosedSolids::ClosedSolids(const TraceScene& traced) : traced_(traced) {
    for (uint32_t g = 0; g < traced.geometry_count(); ++g) add_parts_of(g);
}

void ClosedSolids::add_parts_of(uint32_t geometry) {
    const uint32_t count = traced_.triangle_count(geometry);
    Edges edges(traced_, geometry);
    is_of_closed_part_.emplace_back(count);
    std::map<uint32_t, Part> parts;
    for (uint32_t p = 0; p < count; ++p) {
        const uint32_t number = edges.part_of(p);
        if (edges.is_open(number)) continue;
        is_of_closed_part_[geometry][p] = true;
        const auto corners = traced_.triangle(geometry, p);
        Part& part =
            parts.try_emplace(number, Part{geometry, corners[0], corners[0], {}}).first->second;
        for (const glm::vec3& corner : corners) {
            part.min = glm::min(part.min, corner);
            part.max = glm::max(part.max, corner);
        }
        part.triangles.push_back(
            {glm::dvec3(corners[0]), glm::dvec3(corners[1]), glm::dvec3(corners[2])});
    }
    for (auto& [number, part] : parts) parts_.push_back(std::move(part));
}

bool ClosedSolids::hold(glm::vec3 position) const {
    constexpr double kSphere = 4.0 * std::numbers::pi;
    double winding = 0.0;  // of the parts of one mesh; cavities wind the other way
    for (size_t i = 0; i < parts_.size(); ++i) {
        const Part& part = parts_[i];
        if (i > 0 && parts_[i - 1].geometry != part.geometry) winding = 0.0;
        const bool is_near = glm::all(glm::greaterThan(position, part.min)) &&
                             glm::all(glm::lessThan(position, part.max));
        if (is_near) {
            for (const auto& corners : part.triangles) {
                winding += solid_angle(corners, glm::dvec3(position)) / kSphere;
            }
        }
        const bool is_last = i + 1 == parts_.size() || parts_[i + 1].geometry != part.geometry;
        if (is_last && winding > 0.5) return true;
    }
    return false;
}

bool ClosedSolids::decide(glm::vec3 position) const {
    return std::ranges::all_of(probe_visibility_directions(), [&](const glm::vec3& direction) {
        const auto side = traced_.intersect_side({position, direction});
        return !side || !side->is_from_behind ||
               is_of_closed_part_[side->geometry][side->primitive];
    });
}

}  // namespace tetralight::bench
