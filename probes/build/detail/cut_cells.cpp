// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/cut_cells.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

namespace tetralight::detail {
namespace {

using Edge = std::pair<uint32_t, uint32_t>;

class CellCutter {
  public:
    CellCutter(const ProbeVolumeView& volume, std::span<const uint32_t> kept,
               std::span<const uint32_t> cell_places, std::span<const uint32_t> probe_places)
        : volume_(volume),
          kept_(kept),
          cell_places_(cell_places),
          probe_places_(probe_places),
          center_(middle_of_kept()) {}

    CutCells run() {
        cut_.cell_count = static_cast<uint32_t>(kept_.size());
        for (const uint32_t cell : kept_) add_cell(cell);
        for (const uint32_t cell : kept_) add_cut_faces(cell);
        for (const CutFace& face : faces_) link_cut_face(face);
        for (const uint32_t cell : kept_) {
            if (!is_inner(cell)) link_hull_cell(cell);
        }
        return std::move(cut_);
    }

  private:
    /// A face of a kept tetrahedron whose neighbor is not kept.
    struct CutFace {
        uint32_t cell = 0;  ///< of the volume
        size_t face = 0;
        uint32_t place = 0;  ///< of its hull cell, in the part
    };

    [[nodiscard]] bool is_inner(uint32_t cell) const {
        return cell < volume_.info.inner_cell_count;
    }

    [[nodiscard]] bool is_kept(uint32_t cell) const { return cell_places_[cell] != kNoIndex; }

    [[nodiscard]] glm::dvec3 middle_of_kept() const {
        glm::dvec3 sum(0.0);
        double count = 0.0;
        for (const uint32_t cell : kept_) {
            sum += glm::dvec3(volume_.positions[volume_.cells[cell].vertices[0]]);
            count += 1.0;
        }
        return count > 0.0 ? sum / count : sum;
    }

    void add_cell(uint32_t cell) {
        Cell part = volume_.cells[cell];
        for (uint32_t& vertex : part.vertices) {
            if (vertex != kNoIndex) vertex = probe_places_[vertex];
        }
        for (uint32_t& neighbor : part.neighbors) {
            if (neighbor != kNoIndex) neighbor = cell_places_[neighbor];
        }
        cut_.cells.push_back(part);
        if (is_inner(cell)) {
            ++cut_.inner_cell_count;
        } else {
            cut_.hull_rays.push_back(volume_.hull_rays[cell - volume_.info.inner_cell_count]);
        }
    }

    void add_cut_faces(uint32_t cell) {
        if (!is_inner(cell)) return;
        for (size_t face = 0; face < 4; ++face) {
            if (is_kept(volume_.cells[cell].neighbors[face])) continue;
            const auto place = static_cast<uint32_t>(cut_.cells.size());
            faces_.push_back({cell, face, place});
            place_of_face_[{cell, static_cast<uint32_t>(face)}] = place;
            Cell part;
            HullCellRays rays;
            for (size_t i = 0; i < 3; ++i) {
                const auto corner = static_cast<size_t>(kOutwardFaces[face][i]);
                const uint32_t probe = volume_.cells[cell].vertices[corner];
                part.vertices[i] = probe_places_[probe];
                rays.rays[i] = ray_from_center(probe);
            }
            part.neighbors[3] = cell_places_[cell];
            cut_.cells[cell_places_[cell]].neighbors[face] = place;
            cut_.cells.push_back(part);
            cut_.hull_rays.push_back(rays);
        }
    }

    [[nodiscard]] glm::vec3 ray_from_center(uint32_t probe) const {
        const glm::dvec3 away = glm::dvec3(volume_.positions[probe]) - center_;
        const double length = glm::length(away);
        return length > 0.0 ? glm::vec3(away / length) : glm::vec3(0.0f, 1.0f, 0.0f);
    }

    void link_cut_face(const CutFace& face) {
        const auto& vertices = volume_.cells[face.cell].vertices;
        for (size_t i = 0; i < 3; ++i) {
            const auto corner = [&](size_t k) {
                return vertices[static_cast<size_t>(kOutwardFaces[face.face][k % 3])];
            };
            const uint32_t beyond = volume_.cells[face.cell].neighbors[face.face];
            cut_.cells[face.place].neighbors[i] =
                go_around({corner(i + 1), corner(i + 2)}, face.cell, beyond);
        }
    }

    void link_hull_cell(uint32_t cell) {
        const Cell& whole = volume_.cells[cell];
        for (size_t side = 0; side < 3; ++side) {
            if (is_kept(whole.neighbors[side])) continue;
            const Edge edge{whole.vertices[(side + 1) % 3], whole.vertices[(side + 2) % 3]};
            cut_.cells[cell_places_[cell]].neighbors[side] =
                go_around(edge, cell, whole.neighbors[side]);
        }
    }

    /// Goes around an edge from a kept cell, over cells that are not kept, to the next kept one:
    /// the place of that hull cell, or of the hull cell on the face where that tetrahedron was cut.
    [[nodiscard]] uint32_t go_around(const Edge& edge, uint32_t from, uint32_t cell) const {
        while (!is_kept(cell)) from = std::exchange(cell, next_around(edge, from, cell));
        if (!is_inner(cell)) return cell_places_[cell];
        const auto& neighbors = volume_.cells[cell].neighbors;
        const auto face =
            static_cast<uint32_t>(std::ranges::find(neighbors, from) - neighbors.begin());
        return place_of_face_.at({cell, face});
    }

    /// The neighbor of a cell at an edge that is not `from`.
    [[nodiscard]] uint32_t next_around(const Edge& edge, uint32_t from, uint32_t cell) const {
        const Cell& at = volume_.cells[cell];
        for (size_t i = 0; i < 4; ++i) {
            // Opposite of a vertex of the edge, the face does not have the edge.
            const uint32_t vertex = at.vertices[i];
            const bool has_edge = vertex != edge.first && vertex != edge.second;
            if (has_edge && at.neighbors[i] != from) return at.neighbors[i];
        }
        return from;
    }

    const ProbeVolumeView& volume_;
    std::span<const uint32_t> kept_;
    std::span<const uint32_t> cell_places_;
    std::span<const uint32_t> probe_places_;
    glm::dvec3 center_;
    CutCells cut_;
    std::vector<CutFace> faces_;
    std::map<Edge, uint32_t> place_of_face_;
};

}  // namespace

CutCells cut_cells(const ProbeVolumeView& volume, std::span<const uint32_t> kept,
                   std::span<const uint32_t> cell_places, std::span<const uint32_t> probe_places) {
    return CellCutter(volume, kept, cell_places, probe_places).run();
}

}  // namespace tetralight::detail
