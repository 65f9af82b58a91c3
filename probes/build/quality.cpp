// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/quality.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <initializer_list>
#include <numbers>

namespace tetralight {

double tetrahedron_quality(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                           const glm::dvec3& d) {
    double squares = 0.0;
    for (const glm::dvec3& edge : {b - a, c - a, d - a, c - b, d - b, d - c}) {
        squares += glm::dot(edge, edge);
    }
    const double rms_edge = std::sqrt(squares / 6.0);
    if (rms_edge == 0.0) return 0.0;
    const double six_volumes = glm::dot(b - a, glm::cross(c - a, d - a));
    return std::numbers::sqrt2 * six_volumes / (rms_edge * rms_edge * rms_edge);
}

double QualityReport::sliver_fraction() const {
    return tetrahedra == 0 ? 0.0 : static_cast<double>(slivers) / static_cast<double>(tetrahedra);
}

QualityReport measure_quality(std::span<const glm::dvec3> positions,
                              std::span<const Cell> tetrahedra) {
    QualityReport report;
    report.tetrahedra = tetrahedra.size();
    for (const Cell& cell : tetrahedra) {
        const auto& v = cell.vertices;
        const double quality =
            tetrahedron_quality(positions[v[0]], positions[v[1]], positions[v[2]], positions[v[3]]);
        report.slivers += quality < 1e-3;
        report.flat += quality < 1e-6;
        report.smallest = std::min(report.smallest, quality);
    }
    return report;
}

}  // namespace tetralight
