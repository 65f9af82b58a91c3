// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/delaunay/delaunay_tetrahedra.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include <tetralight/probes/delaunay/detail/insertion_order.h>
#include <tetralight/probes/delaunay/detail/neighbor.h>

namespace tetralight {
namespace {

using detail::cell_of;
using detail::corner_of;
using glm::dvec3;

/// The corners of the triangle opposite each corner, in the same sense for all four:
/// counter-clockwise seen from outside.
constexpr uint32_t kOthers[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

/// Neighbors are 4 · cell + corner in 32 bits.
constexpr size_t kMostCells = size_t{1} << 30;

/// Longer walks look for cells in conflict on their way, which are any of the cavity: where cells
/// are long and thin, one is met long before the cell around the position.
constexpr uint32_t kShortWalk = 4;

/// Steps from ghost to ghost at most: what is nearer is not always reached.
constexpr uint32_t kMostGhosts = 32;

Error out_of_memory() {
    return {ErrorCode::OutOfResources,
            "there is not enough memory for the tetrahedra, or there are more than 2^30"};
}

}  // namespace

std::span<const DelaunayCell> DelaunayTetrahedra::cells() const {
    return {cells_.begin(), cells_.size()};
}

uint32_t DelaunayTetrahedra::last_vertex() const {
    return positions_.is_empty() ? 0 : static_cast<uint32_t>(positions_.size() - 1);
}

void DelaunayTetrahedra::clear() {
    const bool was_tracking = is_tracking_;
    *this = DelaunayTetrahedra(memory_);
    is_tracking_ = was_tracking;
    is_made_anew_ = was_tracking;
}

void DelaunayTetrahedra::forget_changes() {
    changed_cells_.clear();
    is_made_anew_ = false;
}

bool DelaunayTetrahedra::reserve_changes(size_t count) {
    return !is_tracking_ || changed_cells_.reserve(changed_cells_.size() + count);
}

/// Precondition: there is room.
void DelaunayTetrahedra::note_change(uint32_t cell) {
    if (is_tracking_) changed_cells_.push_back(cell);
}

detail::GrowingArray<DelaunayCell> DelaunayTetrahedra::take_cells() {
    detail::GrowingArray<DelaunayCell> cells = std::move(cells_);
    clear();
    return cells;
}

Status DelaunayTetrahedra::insert(std::span<const dvec3> positions, std::span<uint32_t> vertices) {
    if (add_positions(positions, vertices) && insert_all(vertices)) return Ok{};
    clear();
    return out_of_memory();
}

/// Gives positions numbers of vertices.
bool DelaunayTetrahedra::add_positions(std::span<const dvec3> positions,
                                       std::span<uint32_t> vertices) {
    const size_t most = positions_.size() + positions.size() + 1;
    if (!positions_.reserve(most) || !local_numbers_.reserve(most)) return false;
    if (positions_.is_empty()) {
        positions_.push_back(dvec3(0.0));
        local_numbers_.push_back({0, 0});
    }
    for (size_t i = 0; i < positions.size(); ++i) {
        if (free_vertices_.is_empty()) {
            vertices[i] = static_cast<uint32_t>(positions_.size());
            positions_.push_back(positions[i]);
            local_numbers_.push_back({0, 0});
        } else {
            vertices[i] = free_vertices_.back();
            free_vertices_.pop_back();
            positions_[vertices[i]] = positions[i];
        }
    }
    predicates_.include(positions);
    return true;
}

/// Inserts vertices, or all vertices once they do not lie in one plane any more.
bool DelaunayTetrahedra::insert_all(std::span<const uint32_t> vertices) {
    const bool is_first = cells_.is_empty();
    const size_t count = is_first ? positions_.size() - 1 - free_vertices_.size() : vertices.size();
    detail::GrowingArray<uint32_t> order(memory_);
    if (!order.reserve(2 * count)) return false;
    if (is_first) {
        for (uint32_t vertex = 1; vertex <= last_vertex(); ++vertex) {
            if (is_alive(vertex)) order.push_back(vertex);
        }
    } else {
        for (const uint32_t vertex : vertices) order.push_back(vertex);
    }
    order.set_size(2 * count);
    const std::span<uint32_t> ordered(order.begin(), count);
    std::array<uint32_t, 4> corners{};
    detail::order_by_rounds(ordered, {order.begin() + count, count});
    if (is_first) {
        if (!find_first_cell(ordered, corners)) return true;
        if (!begin(corners)) return false;
    }
    for (const uint32_t vertex : ordered) {
        const bool is_corner = is_first && std::ranges::find(corners, vertex) != corners.end();
        if (!is_corner && !insert_vertex(vertex)) return false;
    }
    return true;
}

bool DelaunayTetrahedra::is_alive(uint32_t vertex) const {
    return !std::isnan(positions_[vertex].x);
}

/// The first four vertices that do not lie in one plane.
bool DelaunayTetrahedra::find_first_cell(std::span<const uint32_t> vertices,
                                         std::array<uint32_t, 4>& corners) const {
    if (vertices.size() < 4) return false;
    auto& [a, b, c, d] = corners;
    a = vertices[0];
    b = vertices[1];
    size_t next = 2;
    const auto at = [&](uint32_t vertex) -> const dvec3& { return positions_[vertex]; };
    while (next < vertices.size() &&
           detail::DelaunayPredicates::are_collinear(at(a), at(b), at(vertices[next]))) {
        ++next;
    }
    if (next == vertices.size()) return false;
    c = vertices[next];
    while (++next < vertices.size()) {
        d = vertices[next];
        const int sign = predicates_.orientation(at(a), at(b), at(c), at(d));
        if (sign < 0) std::swap(a, b);
        if (sign != 0) return true;
    }
    return false;
}

/// The first tetrahedron, with a ghost behind each of its triangles.
bool DelaunayTetrahedra::begin(const std::array<uint32_t, 4>& corners) {
    constexpr size_t kCellCount = 5;
    changed_cells_.clear();
    is_made_anew_ = true;
    const size_t expected = positions_.size() * 7 + kCellCount;
    if (!reserve_cells(std::min<size_t>(expected, kMostCells))) return false;
    cells_.push_back({corners, {}});
    for (uint32_t corner = 0; corner < 4; ++corner) {
        // The ghost in place of the corner is on the other side of the triangle, and comes last.
        std::array<uint32_t, 4> vertices = corners;
        vertices[corner] = DelaunayCell::kGhost;
        std::swap(vertices[corner], vertices[3]);
        if (corner == 3) std::swap(vertices[0], vertices[1]);
        cells_.push_back({vertices, {}});
    }
    marks_.set_size(kCellCount);
    std::fill(marks_.begin(), marks_.end(), 0u);
    for (uint32_t a = 0; a < kCellCount; ++a) {
        for (uint32_t b = 0; b < kCellCount; ++b) {
            if (a == b) continue;
            // Cells a and b have all vertices but one in common.
            uint32_t of_a = 0, of_b = 0;
            for (uint32_t i = 0; i < 4; ++i) {
                const auto& [vertices_a, neighbors_a] = cells_[a];
                const auto& [vertices_b, neighbors_b] = cells_[b];
                if (std::ranges::find(vertices_b, vertices_a[i]) == vertices_b.end()) of_a = i;
                if (std::ranges::find(vertices_a, vertices_b[i]) == vertices_a.end()) of_b = i;
            }
            cells_[a].neighbors[of_a] = 4 * b + of_b;
        }
    }
    last_cell_ = 0;
    return true;
}

/// On which side of the triangle opposite a corner a position is: 1 on that of the corner.
int DelaunayTetrahedra::side(const DelaunayCell& cell, uint32_t corner,
                             const dvec3& position) const {
    const auto& [a, b, c, d] = cell.vertices;
    std::array<const dvec3*, 4> p = {&positions_[a], &positions_[b], &positions_[c],
                                     &positions_[d]};
    p[corner] = &position;
    return predicates_.orientation(*p[0], *p[1], *p[2], *p[3]);
}

/// Goes over the hull from a ghost to others whose triangle is nearer to a position: where sets are
/// surfaces, the cells under it are long and thin, and a walk through them takes many steps.
uint32_t DelaunayTetrahedra::nearest_ghost(uint32_t ghost, const dvec3& position) const {
    const auto distance = [&](uint32_t cell) {
        const auto& [a, b, c, d] = cells_[cell].vertices;
        const dvec3 to = positions_[a] + positions_[b] + positions_[c] - 3.0 * position;
        return to.x * to.x + to.y * to.y + to.z * to.z;
    };
    double nearest = distance(ghost);
    for (uint32_t steps = 0; steps < kMostGhosts; ++steps) {
        const uint32_t from = ghost;
        for (uint32_t corner = 0; corner < 3; ++corner) {
            const uint32_t other = cell_of(cells_[from].neighbors[corner]);
            const double distance_of_other = distance(other);
            if (distance_of_other >= nearest) continue;
            nearest = distance_of_other;
            ghost = other;
        }
        if (ghost == from) break;
    }
    return ghost;
}

/// Walks from the last cell to one in conflict with a position: the tetrahedron around it, a ghost
/// whose triangle sees it, or one before. A walk that crosses any triangle that has the position
/// beyond it ends: the tetrahedra are Delaunay (Devillers, Pion and Teillaud, "Walking in a
/// triangulation", 2002).
uint32_t DelaunayTetrahedra::locate(const dvec3& position) const {
    uint32_t cell = last_cell_;
    if (cells_[cell].is_ghost()) {
        cell = nearest_ghost(cell, position);
        if (is_in_conflict(cell, position)) return cell;
        cell = cell_of(cells_[cell].neighbors[3]);
    }
    uint32_t entered = 4;  // no corner
    for (uint32_t steps = 0; !cells_[cell].is_ghost(); ++steps) {
        if (steps > kShortWalk && is_in_conflict(cell, position)) break;
        const DelaunayCell& here = cells_[cell];
        uint32_t corner = 0;
        while (corner < 4 && (corner == entered || side(here, corner, position) >= 0)) ++corner;
        if (corner == 4) break;
        entered = corner_of(here.neighbors[corner]);
        cell = cell_of(here.neighbors[corner]);
    }
    return cell;
}

/// True if a position is in the circumsphere of a tetrahedron, or beyond the triangle of a ghost.
/// In the plane of that triangle, the sphere of the tetrahedron before it decides.
bool DelaunayTetrahedra::is_in_conflict(uint32_t cell, const dvec3& position) const {
    const DelaunayCell* tested = &cells_[cell];
    if (tested->is_ghost()) {
        const int sign = side(*tested, 3, position);
        if (sign != 0) return sign > 0;
        tested = &cells_[cell_of(tested->neighbors[3])];
    }
    const auto& [a, b, c, d] = tested->vertices;
    return predicates_.in_sphere(positions_[a], positions_[b], positions_[c], positions_[d],
                                 position) > 0;
}

void DelaunayTetrahedra::begin_round() {
    constexpr uint32_t kLast = 0xffff'fff0u;
    if (round_ >= kLast) {
        std::fill(marks_.begin(), marks_.end(), 0u);
        for (LocalNumber& local : local_numbers_) local = {0, 0};
        round_ = 0;
    }
    round_ += 2;
}

bool DelaunayTetrahedra::insert_vertex(uint32_t vertex) {
    begin_round();
    return find_cavity(vertex, locate(positions_[vertex])) && fill_cavity();
}

/// The cells in conflict with a vertex, and the triangles around them.
bool DelaunayTetrahedra::find_cavity(uint32_t vertex, uint32_t first_cell) {
    const dvec3& position = positions_[vertex];
    cavity_.clear();
    facets_.clear();
    if (!cavity_.reserve(1)) return false;
    cavity_.push_back(first_cell);
    marks_[first_cell] = round_ + 1;
    for (size_t i = 0; i < cavity_.size(); ++i) {
        const DelaunayCell& cell = cells_[cavity_[i]];
        if (!cavity_.reserve(cavity_.size() + 4) || !facets_.reserve(facets_.size() + 4))
            return false;
        for (uint32_t corner = 0; corner < 4; ++corner) {
            const uint32_t neighbor = cell_of(cell.neighbors[corner]);
            if (marks_[neighbor] < round_) {
                const bool is_inside = is_in_conflict(neighbor, position);
                marks_[neighbor] = round_ + (is_inside ? 1 : 0);
                if (is_inside) cavity_.push_back(neighbor);
            }
            if (marks_[neighbor] > round_) continue;
            Facet facet{cell.vertices, cell.neighbors[corner], corner, 0};
            facet.vertices[corner] = vertex;
            facets_.push_back(facet);
        }
    }
    return true;
}

bool DelaunayTetrahedra::reserve_cells(size_t count) {
    return count <= kMostCells && cells_.reserve(count) && marks_.reserve(count);
}

/// Precondition: there is room.
uint32_t DelaunayTetrahedra::take_cell() {
    if (!free_cells_.is_empty()) {
        const uint32_t cell = free_cells_.back();
        free_cells_.pop_back();
        return cell;
    }
    cells_.set_size(cells_.size() + 1);
    marks_.push_back(0);
    return static_cast<uint32_t>(cells_.size() - 1);
}

/// Replaces the cells of the cavity by one on each triangle around it.
bool DelaunayTetrahedra::fill_cavity() {
    if (!free_cells_.reserve(free_cells_.size() + cavity_.size())) return false;
    if (!reserve_cells(cells_.size() + facets_.size())) return false;
    if (!reserve_changes(cavity_.size() + 2 * facets_.size())) return false;
    for (const uint32_t cell : cavity_) {
        cells_[cell].vertices[0] = DelaunayCell::kFree;
        free_cells_.push_back(cell);
        note_change(cell);
    }
    uint32_t last_ghost = DelaunayCell::kFree;
    for (Facet& facet : facets_) {
        facet.cell = take_cell();
        if (facet.vertices[3] == DelaunayCell::kGhost) last_ghost = facet.cell;
        DelaunayCell& cell = cells_[facet.cell];
        cell.vertices = facet.vertices;
        cell.neighbors[facet.corner] = facet.outside;
        marks_[facet.cell] = 0;
        note_change(facet.cell);
        note_change(cell_of(facet.outside));
        cells_[cell_of(facet.outside)].neighbors[corner_of(facet.outside)] =
            4 * facet.cell + facet.corner;
    }
    last_cell_ = last_ghost != DelaunayCell::kFree ? last_ghost : facets_.back().cell;
    if (number_vertices()) {
        link_by_table();
        return true;
    }
    return link_by_sorting();
}

/// Numbers the vertices around the cavity; false if there are too many for the table.
bool DelaunayTetrahedra::number_vertices() {
    // A closed surface of triangles has half as many vertices as triangles, and 2.
    if (facets_.size() > 2 * kTableSize - 4) return false;
    uint32_t count = 0;
    for (const Facet& facet : facets_) {
        for (const uint32_t other : kOthers[facet.corner]) {
            LocalNumber& local = local_numbers_[facet.vertices[other]];
            if (local.round != round_) local = {round_, count++};
        }
    }
    return true;
}

/// Links the new cells with each other: two of them share each edge around the cavity, which they
/// pass in opposite directions.
void DelaunayTetrahedra::link_by_table() {
    const auto number = [&](uint32_t vertex) { return local_numbers_[vertex].number; };
    for (const Facet& facet : facets_) {
        const auto& [i, j, k] = kOthers[facet.corner];
        const uint32_t a = number(facet.vertices[i]), b = number(facet.vertices[j]),
                       c = number(facet.vertices[k]);
        table_[b * kTableSize + c] = 4 * facet.cell + i;
        table_[c * kTableSize + a] = 4 * facet.cell + j;
        table_[a * kTableSize + b] = 4 * facet.cell + k;
    }
    for (const Facet& facet : facets_) {
        const auto& [i, j, k] = kOthers[facet.corner];
        const uint32_t a = number(facet.vertices[i]), b = number(facet.vertices[j]),
                       c = number(facet.vertices[k]);
        auto& neighbors = cells_[facet.cell].neighbors;
        neighbors[i] = table_[c * kTableSize + b];
        neighbors[j] = table_[a * kTableSize + c];
        neighbors[k] = table_[b * kTableSize + a];
    }
}

/// As `link_by_table`, for any number of vertices.
bool DelaunayTetrahedra::link_by_sorting() {
    sides_.clear();
    if (!sides_.reserve(facets_.size() * 3)) return false;
    for (const Facet& facet : facets_) {
        const auto& others = kOthers[facet.corner];
        for (uint32_t i = 0; i < 3; ++i) {
            const uint32_t a = facet.vertices[others[(i + 1) % 3]];
            const uint32_t b = facet.vertices[others[(i + 2) % 3]];
            sides_.push_back({std::min(a, b), std::max(a, b), 4 * facet.cell + others[i]});
        }
    }
    std::sort(sides_.begin(), sides_.end());
    for (size_t i = 0; i + 1 < sides_.size(); i += 2) {
        const uint32_t a = sides_[i][2], b = sides_[i + 1][2];
        cells_[cell_of(a)].neighbors[corner_of(a)] = b;
        cells_[cell_of(b)].neighbors[corner_of(b)] = a;
    }
    return true;
}

/// The cells around vertices, and the triangles around them: a hole to be filled.
bool DelaunayTetrahedra::find_hole(std::span<const uint32_t> vertices) {
    begin_round();
    constexpr uint32_t kSeen = 1;
    for (const uint32_t vertex : vertices) local_numbers_[vertex] = {round_, 0};
    cavity_.clear();
    facets_.clear();
    size_t looked_at = 0;
    const auto add = [&](uint32_t cell) {
        if (marks_[cell] == round_ || cells_[cell].is_free()) return true;
        bool is_in_hole = false;
        for (const uint32_t vertex : cells_[cell].vertices) {
            LocalNumber& local = local_numbers_[vertex];
            if (local.round != round_) continue;
            local.number = kSeen;
            is_in_hole = true;
        }
        if (!is_in_hole) return true;
        if (!cavity_.reserve(cavity_.size() + 1)) return false;
        cavity_.push_back(cell);
        marks_[cell] = round_;
        return true;
    };
    for (const uint32_t vertex : vertices) {
        if (local_numbers_[vertex].number == kSeen) continue;
        // Cells that have the vertex are the only ones around its position, or in conflict with it.
        const uint32_t first = locate(positions_[vertex]);
        if (!add(first)) return false;
        last_cell_ = first;
        for (; looked_at < cavity_.size(); ++looked_at) {
            for (const uint32_t neighbor : cells_[cavity_[looked_at]].neighbors) {
                if (!add(cell_of(neighbor))) return false;
            }
        }
    }
    for (const uint32_t cell : cavity_) {
        const auto& [corners, neighbors] = cells_[cell];
        for (uint32_t corner = 0; corner < 4; ++corner) {
            if (marks_[cell_of(neighbors[corner])] == round_) continue;
            if (!facets_.reserve(facets_.size() + 1)) return false;
            facets_.push_back({corners, neighbors[corner], corner, 0});
        }
    }
    return true;
}

/// The vertices around the hole.
bool DelaunayTetrahedra::find_rim(detail::GrowingArray<uint32_t>& rim) {
    local_numbers_[DelaunayCell::kGhost].round = round_;
    for (const uint32_t cell : cavity_) {
        if (!rim.reserve(rim.size() + 4)) return false;
        for (const uint32_t vertex : cells_[cell].vertices) {
            if (local_numbers_[vertex].round >= round_) continue;
            local_numbers_[vertex].round = round_ + 1;
            rim.push_back(vertex);
        }
    }
    return true;
}

/// Makes all cells anew.
bool DelaunayTetrahedra::rebuild() {
    cells_.clear();
    marks_.clear();
    free_cells_.clear();
    changed_cells_.clear();
    is_made_anew_ = true;
    return insert_all({});
}

Status DelaunayTetrahedra::remove(std::span<const uint32_t> vertices) {
    if (vertices.empty() || remove_all(vertices)) return Ok{};
    clear();
    return out_of_memory();
}

bool DelaunayTetrahedra::remove_all(std::span<const uint32_t> vertices) {
    if (!free_vertices_.reserve(free_vertices_.size() + vertices.size())) return false;
    const bool has_cells = !cells_.is_empty();
    if (has_cells && !find_hole(vertices)) return false;
    for (const uint32_t vertex : vertices) {
        positions_[vertex].x = std::numeric_limits<double>::quiet_NaN();
        free_vertices_.push_back(vertex);
    }
    if (!has_cells) return true;
    if (facets_.is_empty()) return rebuild();  // every cell has a removed vertex
    detail::GrowingArray<uint32_t> rim(memory_);
    detail::GrowingArray<dvec3> places(memory_);
    detail::GrowingArray<uint32_t> numbers(memory_);
    if (!find_rim(rim) || !places.reserve(rim.size()) || !numbers.reserve(rim.size())) return false;
    for (const uint32_t vertex : rim) places.push_back(positions_[vertex]);
    numbers.set_size(rim.size());
    DelaunayTetrahedra patch(memory_);
    if (!patch.insert({places.begin(), places.size()}, {numbers.begin(), numbers.size()}))
        return false;
    if (patch.cells_.is_empty()) return rebuild();
    const auto filled = fill_hole(patch, {rim.begin(), rim.size()});
    if (filled == Filled::OutOfMemory) return false;
    return filled == Filled::Yes || rebuild();
}

/// Fills the hole with the cells of `patch` that lie in it. `rim`: the vertex of this set of each
/// vertex of the patch, which are numbered from 1 in this order.
DelaunayTetrahedra::Filled DelaunayTetrahedra::fill_hole(const DelaunayTetrahedra& patch,
                                                         std::span<const uint32_t> rim) {
    struct Side {
        std::array<uint32_t, 3> corners;  // ascending
        bool is_turned;                   // in the order of kOthers: an odd permutation of these
        uint32_t facet;
    };

    const auto side_of = [](const std::array<uint32_t, 4>& vertices, uint32_t corner) {
        Side side{{vertices[kOthers[corner][0]], vertices[kOthers[corner][1]],
                   vertices[kOthers[corner][2]]},
                  false,
                  0};
        auto& [a, b, c] = side.corners;
        const auto order = [&](uint32_t& first, uint32_t& second) {
            if (first < second) return;
            std::swap(first, second);
            side.is_turned = !side.is_turned;
        };
        order(a, b);
        order(b, c);
        order(a, b);
        return side;
    };
    const auto is_before = [](const Side& a, const Side& b) { return a.corners < b.corners; };

    detail::GrowingArray<Side> sides(memory_);
    if (!sides.reserve(facets_.size())) return Filled::OutOfMemory;
    for (uint32_t i = 0; i < facets_.size(); ++i) {
        Side side = side_of(facets_[i].vertices, facets_[i].corner);
        side.facet = i;
        sides.push_back(side);
        facets_[i].cell = DelaunayCell::kFree;
    }
    std::sort(sides.begin(), sides.end(), is_before);

    // The vertices of the patch, as those of this set.
    const auto mapped = [&](const DelaunayCell& cell) {
        std::array<uint32_t, 4> vertices = cell.vertices;
        for (uint32_t& vertex : vertices) {
            if (vertex != DelaunayCell::kGhost) vertex = rim[vertex - 1];
        }
        return vertices;
    };
    // The facet of the hole that a cell of the patch has from inside.
    constexpr uint32_t kNone = DelaunayCell::kFree;
    const auto facet_of = [&](const std::array<uint32_t, 4>& vertices, uint32_t corner) {
        const Side side = side_of(vertices, corner);
        const Side* found = std::lower_bound(sides.begin(), sides.end(), side, is_before);
        const bool is_found = found != sides.end() && found->corners == side.corners;
        return is_found && found->is_turned == side.is_turned ? found->facet : kNone;
    };

    // For each cell of the patch: kNone, or the cell of this set that it becomes.
    detail::GrowingArray<uint32_t> becomes(memory_), inside(memory_);
    if (!becomes.reserve(patch.cells_.size())) return Filled::OutOfMemory;
    becomes.set_size(patch.cells_.size());
    std::fill(becomes.begin(), becomes.end(), kNone);
    if (!free_cells_.reserve(free_cells_.size() + cavity_.size())) return Filled::OutOfMemory;
    if (!reserve_cells(cells_.size() + patch.cells_.size()) || !inside.reserve(patch.cells_.size()))
        return Filled::OutOfMemory;
    if (!reserve_changes(cavity_.size() + patch.cells_.size() + facets_.size()))
        return Filled::OutOfMemory;
    for (const uint32_t cell : cavity_) {
        cells_[cell].vertices[0] = DelaunayCell::kFree;
        free_cells_.push_back(cell);
        note_change(cell);
    }
    const auto add = [&](uint32_t patch_cell) {
        if (becomes[patch_cell] != kNone) return;
        becomes[patch_cell] = take_cell();
        cells_[becomes[patch_cell]].vertices = mapped(patch.cells_[patch_cell]);
        marks_[becomes[patch_cell]] = 0;
        inside.push_back(patch_cell);
        note_change(becomes[patch_cell]);
    };
    for (uint32_t cell = 0; cell < patch.cells_.size(); ++cell) {
        if (patch.cells_[cell].is_free()) continue;
        const auto vertices = mapped(patch.cells_[cell]);
        for (uint32_t corner = 0; corner < 4; ++corner) {
            if (facet_of(vertices, corner) != kNone) add(cell);
        }
    }
    for (size_t i = 0; i < inside.size(); ++i) {
        const DelaunayCell& source = patch.cells_[inside[i]];
        const uint32_t here = becomes[inside[i]];
        for (uint32_t corner = 0; corner < 4; ++corner) {
            const uint32_t facet = facet_of(cells_[here].vertices, corner);
            if (facet != kNone) {
                const uint32_t outside = facets_[facet].outside;
                facets_[facet].cell = here;
                note_change(cell_of(outside));
                cells_[here].neighbors[corner] = outside;
                cells_[cell_of(outside)].neighbors[corner_of(outside)] = 4 * here + corner;
                continue;
            }
            const uint32_t neighbor = source.neighbors[corner];
            add(cell_of(neighbor));
            cells_[here].neighbors[corner] = 4 * becomes[cell_of(neighbor)] + corner_of(neighbor);
        }
    }
    if (!inside.is_empty()) last_cell_ = becomes[inside[0]];
    const bool is_whole = std::ranges::all_of(
        facets_, [](const Facet& facet) { return facet.cell != DelaunayCell::kFree; });
    return is_whole ? Filled::Yes : Filled::No;
}

}  // namespace tetralight
