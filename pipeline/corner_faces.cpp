// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/corner_faces.h>

#include <tetralight/base/contract.h>

namespace tetralight {
namespace {

CornerFace face_opposite(const ProbeVolumeView& volume, uint32_t cell, uint32_t probe) {
    CornerFace face{.cell = cell, .probe = probe};
    for (int i = 0; i < cell_vertex_count(volume.info.dimension); ++i) {
        const uint32_t vertex = volume.cells[cell].vertices[i];
        if (vertex != probe) face.others[face.other_count++] = vertex;
    }
    return face;
}

}  // namespace

CornerFaces::CornerFaces(const ProbeVolumeView& volume)
    : volume_(volume), first_(volume.positions.size() + 1, 0) {
    const int count = cell_vertex_count(volume.info.dimension);
    const auto cells = volume.cells.first(volume.info.inner_cell_count);
    for (const Cell& cell : cells) {
        for (int i = 0; i < count; ++i) ++first_[cell.vertices[i]];
    }
    size_t end = 0;
    for (size_t& first : first_) end = first += end;
    cells_.resize(end);
    for (size_t cell = cells.size(); cell-- > 0;) {
        for (int i = 0; i < count; ++i) {
            cells_[--first_[cells[cell].vertices[i]]] = static_cast<uint32_t>(cell);
        }
    }
}

std::vector<CornerFace> CornerFaces::faces(uint32_t probe) const {
    std::vector<CornerFace> faces;
    for (size_t i = first_[probe]; i < first_[probe + 1]; ++i) {
        faces.push_back(face_opposite(volume_, cells_[i], probe));
    }
    return faces;
}

std::vector<glm::dvec3> face_positions(int vertex_count, int divisions) {
    TETRALIGHT_ASSERT(vertex_count >= 1 && vertex_count <= 3, "a face has one to three vertices");
    const double unit = 1.0 / (divisions + 1.0), inset = unit / vertex_count;
    if (vertex_count == 1) return {{1, 0, 0}};
    std::vector<glm::dvec3> positions;
    for (int i = 0; i <= divisions; ++i) {
        const int rest = divisions - i;
        if (vertex_count == 2) positions.emplace_back(inset + i * unit, inset + rest * unit, 0.0);
        for (int j = 0; vertex_count == 3 && j <= rest; ++j) {
            positions.emplace_back(inset + i * unit, inset + j * unit, inset + (rest - j) * unit);
        }
    }
    return positions;
}

}  // namespace tetralight
