// SPDX-License-Identifier: Apache-2.0
#include <tetralight/engines/detail/convex_part.h>

#include <cmath>

#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {
namespace {

/// Cuts the faces of a part one by one, and closes the hole.
class PartCutter {
  public:
    PartCutter(const ConvexPart& part, std::vector<double> distances)
        : part_(part), distances_(std::move(distances)), kept_(part.points.size(), kNoIndex) {}

    ConvexPart cut() {
        for (size_t at = 0; at < part_.faces.size(); at += part_.faces[at] + 1) cut_face(at);
        close();
        return std::move(result_);
    }

  private:
    struct CutEdge {
        uint32_t first, second;  ///< points of the part, the lower index first
        uint32_t point;
    };

    const ConvexPart& part_;
    std::vector<double> distances_;
    std::vector<uint32_t> kept_;
    std::vector<CutEdge> cut_edges_;
    ConvexPart result_;
    /// One a point of the result: whether it is in the plane.
    std::vector<bool> is_in_plane_;
    /// Edges in the plane, as the new face goes around them.
    std::vector<std::array<uint32_t, 2>> rim_;

    void cut_face(size_t at) {
        const uint32_t count = part_.faces[at];
        const uint32_t* corners = part_.faces.data() + at + 1;
        std::vector<uint32_t> loop;
        bool is_outside_plane = false;
        for (uint32_t i = 0; i < count; ++i) {
            const uint32_t corner = corners[i];
            const uint32_t next = corners[(i + 1) % count];
            is_outside_plane |= distances_[corner] > 0.0;
            if (distances_[corner] >= 0.0) loop.push_back(kept(corner));
            if (distances_[corner] * distances_[next] < 0.0) {
                loop.push_back(between(corner, next));
            }
        }
        if (!is_outside_plane || loop.size() < 3) return;
        result_.faces.push_back(static_cast<uint32_t>(loop.size()));
        for (size_t i = 0; i < loop.size(); ++i) {
            const uint32_t next = loop[(i + 1) % loop.size()];
            result_.faces.push_back(loop[i]);
            if (is_in_plane_[loop[i]] && is_in_plane_[next]) rim_.push_back({next, loop[i]});
        }
    }

    uint32_t add(const glm::dvec3& point, bool is_in_plane) {
        result_.points.push_back(point);
        is_in_plane_.push_back(is_in_plane);
        return static_cast<uint32_t>(result_.points.size() - 1);
    }

    uint32_t kept(uint32_t point) {
        if (kept_[point] == kNoIndex) {
            kept_[point] = add(part_.points[point], distances_[point] == 0.0);
        }
        return kept_[point];
    }

    uint32_t between(uint32_t a, uint32_t b) {
        if (a > b) std::swap(a, b);
        for (const CutEdge& edge : cut_edges_) {
            if (edge.first == a && edge.second == b) return edge.point;
        }
        const double share = distances_[a] / (distances_[a] - distances_[b]);
        const uint32_t point =
            add(part_.points[a] + share * (part_.points[b] - part_.points[a]), true);
        cut_edges_.push_back({a, b, point});
        return point;
    }

    /// The face in the plane: its edges, one after the other.
    void close() {
        if (rim_.size() < 3) return;
        std::vector<uint32_t> loop{rim_[0][0]};
        uint32_t end = rim_[0][1];
        while (end != loop[0] && loop.size() < rim_.size()) {
            loop.push_back(end);
            for (const auto& edge : rim_) {
                if (edge[0] != end) continue;
                end = edge[1];
                break;
            }
        }
        if (loop.size() < 3) return;
        result_.faces.push_back(static_cast<uint32_t>(loop.size()));
        result_.faces.insert(result_.faces.end(), loop.begin(), loop.end());
    }
};

}  // namespace

double distance_over(const CutPlane& plane, const glm::dvec3& point) {
    const glm::dvec3 product = glm::dvec3(plane.normal) * point;
    const double constant = plane.distance;
    const double distance = product.x + product.y + product.z - constant;
    const double rounding = 0x1p-22 * (std::abs(product.x) + std::abs(product.y) +
                                       std::abs(product.z) + std::abs(constant));
    return std::abs(distance) <= rounding ? 0.0 : distance;
}

ConvexPart convex_part(const std::array<glm::dvec3, 4>& corners) {
    ConvexPart part;
    part.points.assign(corners.begin(), corners.end());
    for (const auto& face : kOutwardFaces) {
        part.faces.push_back(3);
        for (const int corner : face) part.faces.push_back(static_cast<uint32_t>(corner));
    }
    return part;
}

ConvexPart cut(const ConvexPart& part, const CutPlane& plane, Side side) {
    std::vector<double> distances;
    for (const glm::dvec3& point : part.points) {
        const double distance = distance_over(plane, point);
        distances.push_back(side == Side::Over ? distance : -distance);
    }
    return PartCutter(part, std::move(distances)).cut();
}

}  // namespace tetralight::detail
