// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/joined_volume.h>

#include <algorithm>
#include <bit>
#include <deque>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <new>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include <tetralight/base/str_cat.h>
#include <tetralight/base/utf8.h>
#include <tetralight/probes/build/detail/following_cells.h>
#include <tetralight/probes/build/detail/joined_light.h>
#include <tetralight/probes/build/detail/spread.h>
#include <tetralight/probes/build/detail/weld_sources.h>
#include <tetralight/probes/build/hilbert_order.h>
#include <tetralight/probes/build/hull_rays.h>
#include <tetralight/probes/build/make_probe_volume.h>
#include <tetralight/probes/delaunay/delaunay_tetrahedra.h>
#include <tetralight/probes/farthest_position.h>
#include <tetralight/probes/is_finite.h>

namespace tetralight {
namespace {

using Clock = std::chrono::steady_clock;

/// Why a volume cannot join others; empty if it can.
std::string what_is_wrong(const ProbeVolumeView& part) {
    const size_t count = part.probe_count();
    if (part.exact_positions.size() != count) return "it has no exact positions";
    for (size_t i = 0; i < count; ++i) {
        const glm::dvec3& p = part.exact_positions[i];
        if (is_finite(p) && glm::length(p) <= kFarthestPosition) continue;
        return str_cat("the position of probe ", i, " is not finite or beyond 1e18 (", p.x, ", ",
                       p.y, ", ", p.z, ")");
    }
    const auto fits = [&](const auto& values) { return values.empty() || values.size() == count; };
    const bool is_whole = fits(part.irradiance) && fits(part.occlusion) && fits(part.validity) &&
                          fits(part.health) && fits(part.rendering_layers);
    return is_whole ? "" : "it has light of another number of probes";
}

/// Returns out_of_resources if there is no memory of this size. (Containers end a program that is
/// built without exceptions; docs/decisions/0037-memory-through-the-c-api.md.)
Status check_memory(uint64_t byte_count) {
    const bool is_addressable = byte_count <= std::numeric_limits<size_t>::max();
    void* memory =
        is_addressable ? ::operator new(static_cast<size_t>(byte_count), std::nothrow) : nullptr;
    ::operator delete(memory);
    if (memory != nullptr) return Ok{};
    return Error{ErrorCode::OutOfResources,
                 str_cat("cannot allocate ", byte_count, " bytes for joined volumes")};
}

}  // namespace

struct JoinedVolume::State {
    struct PositionHash {
        size_t operator()(const glm::dvec3& p) const {
            uint64_t hash = 0;
            for (int axis = 0; axis < 3; ++axis) {
                hash = (hash ^ std::bit_cast<uint64_t>(p[axis])) * 0x9e3779b97f4a7c15u;
                hash ^= hash >> 32;
            }
            return static_cast<size_t>(hash);
        }
    };

    struct Part : detail::LitPart {
        /// Its probes along a Hilbert curve.
        std::vector<uint32_t> order;
        /// The probe of the joined volume of each of its probes.
        std::vector<uint32_t> probes;
    };

    /// By name.
    using Parts = std::map<std::string, Part, std::less<>>;

    /// What was ordered and is not done.
    struct Order {
        std::string name;
        bool is_add = false;
        Part part;                      ///< of `add`
        std::vector<uint32_t> leaving;  ///< of `remove`: probes that no other part has
        size_t done = 0;                ///< of `part.order` or `leaving`
        bool has_begun = false;
    };

    State(const MergeSettings& merge_settings, const MemorySource& memory)
        : settings(merge_settings), tetrahedra(memory) {
        tetrahedra.track_changes();
    }

    [[nodiscard]] bool will_have(std::string_view name) const;
    [[nodiscard]] Status work(Clock::time_point deadline, size_t batch);
    [[nodiscard]] Status join(Order& order, Clock::time_point deadline, size_t batch);
    [[nodiscard]] Status leave(Order& order, Clock::time_point deadline, size_t batch);
    void begin_to_leave(Order& order);
    void set_source(uint32_t probe, const Part& part, uint32_t index);
    void resize_probes();
    [[nodiscard]] bool has_near_probes() const;
    [[nodiscard]] double farthest_change() const;
    [[nodiscard]] MergedProbes merged() const;
    [[nodiscard]] Status make_anew();
    void write_changes();
    [[nodiscard]] std::vector<const detail::LitPart*> lit_parts() const;
    void fill_light(ProbeVolume& volume, std::span<const detail::LightSource> sources,
                    detail::JoinedWalls& walls) const;
    [[nodiscard]] std::vector<uint32_t> cells_to_light() const;

    MergeSettings settings;
    Parts parts;
    std::deque<Order> orders;

    /// Vertex p + 1 is probe p.
    DelaunayTetrahedra tetrahedra;
    std::unordered_map<glm::dvec3, uint32_t, PositionHash> probe_at;
    /// Of float positions, and the distance of the farthest probe from it.
    glm::dvec3 origin{0.0};
    double farthest = 0.0;
    std::vector<glm::dvec3> positions;         // by probe, those that left included
    std::vector<detail::LightSource> sources;  // by probe
    std::vector<uint32_t> changed;             // probes
    detail::FollowingCells cells;
    detail::JoinedWalls walls;
    /// False: everything is made anew when orders are done.
    bool follows = false;
    /// Something was ordered that no step has finished: also after one that failed at the end.
    bool has_work = false;
    bool is_ready = false;
    /// What `tetrahedra` and `changed` say is not in the volume yet.
    bool must_write = false;

    std::optional<ProbeVolume> next;  // made anew
    ProbeVolume volume;
};

bool JoinedVolume::State::will_have(std::string_view name) const {
    bool has = parts.contains(name);
    for (const Order& order : orders) {
        if (order.name == name) has = order.is_add;
    }
    return has;
}

void JoinedVolume::State::set_source(uint32_t probe, const Part& part, uint32_t index) {
    sources[probe] = {&part, index};
    changed.push_back(probe);
}

void JoinedVolume::State::resize_probes() {
    const size_t count = tetrahedra.last_vertex();
    positions.resize(std::max(positions.size(), count));
    sources.resize(positions.size());
}

/// Inserts the probes of a part, and makes it one of `parts` at the end.
Status JoinedVolume::State::join(Order& order, Clock::time_point deadline, size_t batch) {
    Part& part = order.part;
    if (!follows) {
        order.done = part.order.size();
    } else {
        part.probes.resize(part.order.size());
    }
    std::vector<glm::dvec3> added;
    std::vector<uint32_t> indices, vertices;
    do {
        added.clear();
        indices.clear();
        for (; order.done < part.order.size() && added.size() < batch; ++order.done) {
            const uint32_t index = part.order[order.done];
            const glm::dvec3 position = part.view.exact_positions[index] + 0.0;
            const auto found = probe_at.find(position);
            if (found != probe_at.end()) {
                part.probes[index] = found->second;
                continue;
            }
            added.push_back(position);
            indices.push_back(index);
        }
        vertices.resize(added.size());
        if (auto status = tetrahedra.insert(added, vertices); !status) return status;
        resize_probes();
        for (size_t i = 0; i < added.size(); ++i) {
            const uint32_t probe = vertices[i] - 1;
            part.probes[indices[i]] = probe;
            positions[probe] = added[i];
            probe_at.emplace(added[i], probe);
        }
    } while (order.done < part.order.size() && Clock::now() < deadline);
    if (order.done < part.order.size()) return Ok{};
    const auto joined = parts.emplace(order.name, std::move(part)).first;
    // The part with the smallest name lights a probe that several have.
    if (follows) {
        std::map<const detail::LitPart*, std::string_view> names;
        for (const auto& [name, other] : parts) names.emplace(&other, name);
        for (uint32_t i = 0; i < joined->second.probes.size(); ++i) {
            const uint32_t probe = joined->second.probes[i];
            const detail::LitPart* lighter = sources[probe].part;
            if (lighter == nullptr || joined->first < names[lighter]) {
                set_source(probe, joined->second, i);
            }
        }
    }
    orders.pop_front();
    return Ok{};
}

/// Finds the probes that no other part has, and gives the others the light of those that have them.
void JoinedVolume::State::begin_to_leave(Order& order) {
    order.has_begun = true;
    const auto part = parts.find(order.name);
    if (!follows) {
        parts.erase(part);
        return;
    }
    for (const uint32_t probe : part->second.probes) {
        if (sources[probe].part == &part->second) sources[probe].part = nullptr;
    }
    for (const auto& [name, other] : parts) {
        if (name == order.name) continue;
        for (uint32_t i = 0; i < other.probes.size(); ++i) {
            if (sources[other.probes[i]].part == nullptr) set_source(other.probes[i], other, i);
        }
    }
    for (const uint32_t index : part->second.order) {
        const uint32_t probe = part->second.probes[index];
        if (sources[probe].part != nullptr) continue;
        if (probe_at.erase(positions[probe]) == 0) continue;  // two of its probes are one
        order.leaving.push_back(probe);
        changed.push_back(probe);
    }
    parts.erase(part);
}

Status JoinedVolume::State::leave(Order& order, Clock::time_point deadline, size_t batch) {
    if (!order.has_begun) begin_to_leave(order);
    if (!follows) order.done = order.leaving.size();
    std::vector<uint32_t> vertices;
    do {
        vertices.clear();
        for (; order.done < order.leaving.size() && vertices.size() < batch; ++order.done) {
            vertices.push_back(order.leaving[order.done] + 1);
        }
        if (auto status = tetrahedra.remove(vertices); !status) return status;
    } while (order.done < order.leaving.size() && Clock::now() < deadline);
    if (order.done == order.leaving.size()) orders.pop_front();
    return Ok{};
}

Status JoinedVolume::State::work(Clock::time_point deadline, size_t batch) {
    while (!orders.empty()) {
        Order& order = orders.front();
        const Status status =
            order.is_add ? join(order, deadline, batch) : leave(order, deadline, batch);
        if (!status) return status;
        if (!orders.empty() && Clock::now() >= deadline) return Ok{};
    }
    return Ok{};
}

/// True if probes may be nearer to each other than `merge` leaves them, `radius` at most. Of each
/// probe, the nearest other one is a vertex of a cell around it.
bool JoinedVolume::State::has_near_probes() const {
    constexpr double kLargestSpacing = 10.0, kFloatSteps = 4e-7;
    const double radius =
        std::max(settings.weld_tolerance * kLargestSpacing, 2.0 * kFloatSteps * farthest);
    const auto is_near = [&](const DelaunayCell& cell) {
        if (!cell.is_finite()) return false;
        for (size_t i = 0; i < 4; ++i) {
            for (size_t k = 0; k < i; ++k) {
                const glm::dvec3 d =
                    positions[cell.vertices[i] - 1] - positions[cell.vertices[k] - 1];
                if (glm::dot(d, d) <= radius * radius) return true;
            }
        }
        return false;
    };
    const auto all = tetrahedra.cells();
    if (tetrahedra.is_made_anew()) return std::ranges::any_of(all, is_near);
    return std::ranges::any_of(tetrahedra.changed_cells(),
                               [&](uint32_t cell) { return is_near(all[cell]); });
}

/// The greatest distance of a probe that has changed from the origin of floats.
double JoinedVolume::State::farthest_change() const {
    double result = 0.0;
    for (const uint32_t probe : changed) {
        result = std::max(result, glm::distance(positions[probe], origin));
    }
    return result;
}

/// The probes of all parts as `merge` joins them, each part one group.
MergedProbes JoinedVolume::State::merged() const {
    MergedProbes result;
    std::vector<glm::dvec3> all;
    uint32_t group = 0;
    for (const auto& [name, part] : parts) {
        result.group_names.push_back(name);
        result.group_dering.push_back(false);
        result.group_rendering_layers.push_back(kAllRenderingLayers);
        result.group_empty_warnings.emplace_back();
        result.group_is_lattice.push_back(false);
        for (uint32_t i = 0; i < part.view.exact_positions.size(); ++i) {
            result.sources.push_back({group, i, 0});
            all.push_back(part.view.exact_positions[i] + 0.0);
        }
        ++group;
    }
    detail::weld_sources(all, settings.weld_tolerance, result);
    return result;
}

std::vector<const detail::LitPart*> JoinedVolume::State::lit_parts() const {
    std::vector<const detail::LitPart*> result;
    for (const auto& [name, part] : parts) result.push_back(&part);
    return result;
}

void JoinedVolume::State::fill_light(ProbeVolume& to, std::span<const detail::LightSource> from,
                                     detail::JoinedWalls& to_walls) const {
    std::vector<uint32_t> all(from.size());
    for (uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    detail::set_light(lit_parts(), from, all, to);
    to_walls.set_all(from, to);
}

/// The light of each merged probe: that of its first source whose position it has, or of its first.
std::vector<detail::LightSource> light_sources(const MergedProbes& probes,
                                               std::span<const detail::LitPart* const> parts) {
    std::vector<detail::LightSource> sources(probes.positions.size());
    for (const bool must_be_equal : {true, false}) {
        for (const ProbeSource& source : probes.sources) {
            const detail::LitPart* part = parts[source.group];
            const bool is_equal =
                part->view.exact_positions[source.index] + 0.0 == probes.positions[source.probe];
            detail::LightSource& light = sources[source.probe];
            if (light.part == nullptr && (is_equal || !must_be_equal)) {
                light = {part, source.index};
            }
        }
    }
    return sources;
}

Status JoinedVolume::State::make_anew() {
    constexpr uint64_t kBytesAProbe = 1200;  // at the peak, with all that a volume may have
    uint64_t probe_count = 0;
    for (const auto& [name, part] : parts) probe_count += part.view.exact_positions.size();
    if (auto status = check_memory(probe_count * kBytesAProbe); !status) return status;
    MergedProbes probes = merged();
    tetrahedra.clear();
    follows = false;
    const auto spread = detail::measure_spread(probes.positions, flat_tolerance(probes));
    if (spread.dimension == Dimension::Space) {
        std::vector<uint32_t> vertices(probes.positions.size());
        if (auto status = tetrahedra.insert(probes.positions, vertices); !status) return status;
    }
    Tetrahedralization made;
    if (!tetrahedra.cells().empty()) {
        cells.write_all(tetrahedra, made.cells);
        made.inner_cell_count = cells.inner_count();
        made.dimension = Dimension::Space;
    } else {
        made = tetrahedralize(probes.positions, flat_tolerance(probes));
    }
    next = make_probe_volume(probes, std::move(made));
    sources = light_sources(probes, lit_parts());
    fill_light(*next, sources, walls);
    changed.clear();
    // From now on, probes follow what comes and goes.
    positions = probes.positions;
    origin = next->info.world_origin;
    farthest = double{next->info.extent};
    probe_at.clear();
    for (uint32_t i = 0; i < positions.size(); ++i) probe_at.emplace(positions[i], i);
    bool is_welded = false;
    size_t source = 0;
    for (auto& [name, part] : parts) {
        part.probes.resize(part.view.exact_positions.size());
        for (uint32_t i = 0; i < part.probes.size(); ++i, ++source) {
            part.probes[i] = probes.sources[source].probe;
            is_welded |= positions[part.probes[i]] != part.view.exact_positions[i] + 0.0;
        }
    }
    follows = !tetrahedra.cells().empty() && !is_welded && !has_near_probes();
    tetrahedra.forget_changes();
    return Ok{};
}

/// Cells that were written, and those around probes whose light comes from another part now.
std::vector<uint32_t> JoinedVolume::State::cells_to_light() const {
    std::vector<bool> is_listed(cells.count(), cells.written().empty());
    for (const uint32_t cell : cells.written()) is_listed[cell] = true;
    std::vector<bool> is_changed(positions.size(), false);
    for (const uint32_t probe : changed) is_changed[probe] = true;
    std::vector<uint32_t> result;
    for (uint32_t cell = 0; cell < is_listed.size(); ++cell) {
        const auto& vertices = volume.cells[cell].vertices;
        const bool has_changed = std::ranges::any_of(
            vertices, [&](uint32_t probe) { return probe != kNoIndex && is_changed[probe]; });
        if (is_listed[cell] || has_changed) result.push_back(cell);
    }
    return result;
}

void JoinedVolume::State::write_changes() {
    cells.write_changes(tetrahedra, volume.cells);
    tetrahedra.forget_changes();
    volume.info.inner_cell_count = cells.inner_count();
    const auto hull =
        std::span(volume.cells).subspan(cells.inner_count(), cells.count() - cells.inner_count());
    HullRays rays = make_hull_rays(positions, hull, Dimension::Space, glm::dvec3(0.0));
    volume.info.radial_fraction = rays.radial_fraction;
    volume.hull_rays = std::move(rays.cells);
    volume.hull_rays.resize(volume.cells.size() - cells.inner_count(), volume.hull_rays[0]);
    volume.positions.resize(positions.size());
    volume.exact_positions.resize(positions.size());
    for (const uint32_t probe : changed) {
        volume.exact_positions[probe] = positions[probe];
        volume.positions[probe] = glm::vec3(positions[probe] - volume.info.world_origin);
        volume.info.extent = std::max(volume.info.extent, glm::length(volume.positions[probe]));
    }
    detail::set_light(lit_parts(), sources, changed, volume);
    const auto knows_walls = [](const auto& entry) { return entry.second.walls.has_value(); };
    walls.set(std::ranges::any_of(parts, knows_walls) ? cells_to_light() : std::vector<uint32_t>(),
              cells.count(), sources, volume);
    changed.clear();
    volume.sources.clear();
    volume.group_names.clear();
    uint32_t group = 0;
    for (const auto& [name, part] : parts) {
        for (uint32_t i = 0; i < part.probes.size(); ++i) {
            volume.sources.push_back({group, i, part.probes[i]});
        }
        volume.group_names += name + "\n";
        ++group;
    }
}

JoinedVolume::JoinedVolume(const MergeSettings& settings, const MemorySource& memory)
    : state_(std::make_unique<State>(settings, memory)) {}

JoinedVolume::~JoinedVolume() = default;
JoinedVolume::JoinedVolume(JoinedVolume&&) noexcept = default;
JoinedVolume& JoinedVolume::operator=(JoinedVolume&&) noexcept = default;

Status JoinedVolume::add(std::string_view name, const ProbeVolumeView& part) {
    const auto invalid = [&](const std::string& what) {
        return Error{ErrorCode::InvalidArgument, "name", std::string(name),
                     str_cat("volume \"", name, "\": ", what)};
    };
    if (name.empty()) return invalid("it has no name");
    if (const auto status = check_characters(name); !status) {
        return status.error().in("the name of a volume");
    }
    if (state_->will_have(name)) return invalid("there is one of this name");
    if (const std::string wrong = what_is_wrong(part); !wrong.empty()) return invalid(wrong);
    State::Order order;
    order.name = name;
    order.is_add = true;
    order.part.view = part;
    order.part.order = hilbert_order(part.exact_positions);
    if (!part.visibility_blocks.empty()) order.part.walls.emplace(part);
    state_->orders.push_back(std::move(order));
    state_->is_ready = false;
    state_->has_work = true;
    return Ok{};
}

Status JoinedVolume::remove(std::string_view name) {
    if (!state_->will_have(name)) {
        return Error{ErrorCode::NotFound, "name", std::string(name),
                     str_cat("volume \"", name, "\": there is no such volume")};
    }
    State::Order order;
    order.name = name;
    state_->orders.push_back(std::move(order));
    state_->is_ready = false;
    state_->has_work = true;
    return Ok{};
}

Result<bool> JoinedVolume::step(std::chrono::nanoseconds budget) {
    State& state = *state_;
    if (!state.has_work) return true;
    constexpr std::chrono::nanoseconds kOneProbe = std::chrono::microseconds(10);
    constexpr int64_t kLeast = 8, kMost = 4096;
    const auto batch = static_cast<size_t>(std::clamp<int64_t>(budget / kOneProbe, kLeast, kMost));
    Status status = state.work(Clock::now() + budget, batch);
    if (status && !state.orders.empty()) return false;
    if (status && state.follows) {
        // Floats relative to the origin hold far probes badly.
        const double far = state.farthest_change();
        state.follows = !state.tetrahedra.cells().empty() && far <= 2.0 * state.farthest;
        state.farthest = std::max(state.farthest, far);
        state.follows = state.follows && !state.has_near_probes();
    }
    state.must_write = state.follows;
    if (status && !state.follows) status = state.make_anew();
    if (!status) {
        state.follows = false;
        return status.error();
    }
    state.has_work = false;
    state.is_ready = true;
    return true;
}

void JoinedVolume::commit() {
    State& state = *state_;
    if (!state.is_ready) return;
    state.is_ready = false;
    if (state.next) state.volume = std::move(*state.next);
    state.next.reset();
    if (state.must_write) state.write_changes();
    state.must_write = false;
}

ProbeVolumeView JoinedVolume::view() const {
    return state_->volume.view();
}

ProbeVolume JoinedVolume::canonical() const {
    const MergedProbes probes = state_->merged();
    ProbeVolume volume = make_probe_volume(probes);
    detail::JoinedWalls walls;
    state_->fill_light(volume, light_sources(probes, state_->lit_parts()), walls);
    return volume;
}

}  // namespace tetralight
