// SPDX-License-Identifier: Apache-2.0
// Links CGAL's triangulations (GPL-3.0-or-later): the program `tetralight-cgal` is distributed
// under that licence. Nothing else that is distributed links them; this source alone is Apache-2.0.
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <stdexcept>
#include <utility>

#include <tetralight/probes/programs/stream_io.h>

namespace {

using tetralight::programs::kStreamNoNeighbor;
using tetralight::programs::StreamTetrahedron;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay = CGAL::Delaunay_triangulation_3<
    Kernel, CGAL::Triangulation_data_structure_3<
                CGAL::Triangulation_vertex_base_with_info_3<uint32_t, Kernel>,
                CGAL::Triangulation_cell_base_with_info_3<
                    uint32_t, Kernel, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>>>;

std::vector<StreamTetrahedron> tetrahedra_over(std::vector<double> coordinates) {
    std::vector<std::pair<Kernel::Point_3, uint32_t>> points;
    points.reserve(coordinates.size() / 3);
    for (size_t i = 0; i + 2 < coordinates.size(); i += 3) {
        points.emplace_back(Kernel::Point_3(coordinates[i], coordinates[i + 1], coordinates[i + 2]),
                            static_cast<uint32_t>(i / 3));
    }
    const Delaunay delaunay(points.begin(), points.end());
    if (delaunay.dimension() < 3) throw std::runtime_error("the positions are flat");
    uint32_t next = 0;
    for (const auto cell : delaunay.all_cell_handles()) {
        cell->info() = delaunay.is_infinite(cell) ? kStreamNoNeighbor : next++;
    }
    std::vector<StreamTetrahedron> tetrahedra(next);
    for (const auto cell : delaunay.finite_cell_handles()) {
        for (int i = 0; i < 4; ++i) {
            tetrahedra[cell->info()].vertices[i] = cell->vertex(i)->info();
            tetrahedra[cell->info()].neighbors[i] = cell->neighbor(i)->info();
        }
    }
    return tetrahedra;
}

}  // namespace

int main() {
    // Tetrahedra have 32-bit numbers; a random set has 7 a position.
    return tetralight::programs::run_program("tetralight-cgal", kStreamNoNeighbor / 8,
                                             tetrahedra_over);
}
