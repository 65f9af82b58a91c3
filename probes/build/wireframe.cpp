// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/wireframe.h>

#include <algorithm>
#include <iterator>
#include <span>

#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

std::vector<ProbeEdge> edges_of(std::span<const Cell> cells, int vertex_count) {
    std::vector<ProbeEdge> edges;
    for (const Cell& cell : cells) {
        for (int i = 0; i < vertex_count; ++i) {
            for (int j = i + 1; j < vertex_count; ++j) {
                const auto [low, high] = std::minmax(cell.vertices[i], cell.vertices[j]);
                edges.push_back({low, high});
            }
        }
    }
    std::ranges::sort(edges);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

std::vector<glm::dvec3> world_positions(const ProbeVolumeView& volume) {
    if (!volume.exact_positions.empty()) {
        return {volume.exact_positions.begin(), volume.exact_positions.end()};
    }
    std::vector<glm::dvec3> positions;
    for (const glm::vec3& p : volume.positions) {
        positions.push_back(volume.info.world_origin + glm::dvec3(p));
    }
    return positions;
}

}  // namespace

Wireframe make_wireframe(const ProbeVolumeView& volume) {
    const uint32_t inner = volume.info.inner_cell_count;
    const int vertex_count = cell_vertex_count(volume.info.dimension);
    Wireframe wireframe;
    wireframe.positions = world_positions(volume);
    wireframe.hull_edges = edges_of(volume.cells.subspan(inner), vertex_count - 1);
    const auto all = edges_of(volume.cells.first(inner), vertex_count);
    std::ranges::set_difference(all, wireframe.hull_edges,
                                std::back_inserter(wireframe.inner_edges));
    return wireframe;
}

std::string obj_text(const Wireframe& wireframe) {
    std::string out = "# Tetralight: the probes of a volume and the edges between them\n";
    for (const glm::dvec3& p : wireframe.positions)
        out += str_cat("v ", p.x, ' ', p.y, ' ', p.z, '\n');
    const auto add = [&](const char* group, const std::vector<ProbeEdge>& edges) {
        out += str_cat("g ", group, '\n');
        for (const auto [a, b] : edges) out += str_cat("l ", a + 1, ' ', b + 1, '\n');
    };
    add("cells", wireframe.inner_edges);
    add("hull", wireframe.hull_edges);
    return out;
}

std::string ply_text(const Wireframe& wireframe) {
    std::string out = str_cat(
        "ply\nformat ascii 1.0\ncomment Tetralight: the probes of a volume and the edges between "
        "them\nelement vertex ",
        wireframe.positions.size(),
        "\nproperty double x\nproperty double y\nproperty double z\nelement edge ",
        wireframe.inner_edges.size() + wireframe.hull_edges.size(),
        "\nproperty int vertex1\nproperty int vertex2\nproperty uchar hull\nend_header\n");
    for (const glm::dvec3& p : wireframe.positions) out += str_cat(p.x, ' ', p.y, ' ', p.z, '\n');
    for (const auto [a, b] : wireframe.inner_edges) out += str_cat(a, ' ', b, " 0\n");
    for (const auto [a, b] : wireframe.hull_edges) out += str_cat(a, ' ', b, " 1\n");
    return out;
}

}  // namespace tetralight
