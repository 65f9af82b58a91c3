// SPDX-License-Identifier: Apache-2.0
// Compiled once for each kind of processor: Highway includes this file again and again.
#include "probes/detail/query_kernels.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "probes/detail/query_kernels.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "probes/detail/blend_probes.h"
#include "probes/detail/hull_cell.h"
#include "probes/detail/walk.h"
#include "probes/detail/write_answer.h"

HWY_BEFORE_NAMESPACE();

namespace tetralight::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_MAX_BYTES >= 32

using Double4 = hn::FixedTag<double, 4>;
using Vec4 = hn::Vec<Double4>;

/// One coordinate of the four corners of a tetrahedron.
struct Corners {
    Vec4 x, y, z;
};

/// Corners relative to a position. Three floats a corner are loaded as two overlapping pairs.
HWY_INLINE Corners load_corners(const float* positions, const Cell& cell, Vec4 px, Vec4 py,
                                Vec4 pz) {
    const hn::FixedTag<float, 2> pair;
    const hn::FixedTag<float, 4> four;
    const Double4 wide;
    const float* a = positions + 3 * size_t{cell.vertices[0]};
    const float* b = positions + 3 * size_t{cell.vertices[1]};
    const float* c = positions + 3 * size_t{cell.vertices[2]};
    const float* d = positions + 3 * size_t{cell.vertices[3]};
    const auto xy_ab = hn::Combine(four, hn::LoadU(pair, b), hn::LoadU(pair, a));
    const auto xy_cd = hn::Combine(four, hn::LoadU(pair, d), hn::LoadU(pair, c));
    const auto yz_ab = hn::Combine(four, hn::LoadU(pair, b + 1), hn::LoadU(pair, a + 1));
    const auto yz_cd = hn::Combine(four, hn::LoadU(pair, d + 1), hn::LoadU(pair, c + 1));
    return {hn::Sub(hn::PromoteTo(wide, hn::ConcatEven(four, xy_cd, xy_ab)), px),
            hn::Sub(hn::PromoteTo(wide, hn::ConcatOdd(four, xy_cd, xy_ab)), py),
            hn::Sub(hn::PromoteTo(wide, hn::ConcatOdd(four, yz_cd, yz_ab)), pz)};
}

/// Of (a, b, c, d): (b, a, d, c), (c, c, a, a) and (d, d, b, b), for a cofactor in each lane.
struct Shuffled {
    Vec4 swapped, first, second;
};

HWY_INLINE Shuffled shuffle(Vec4 v) {
    const Double4 wide;
    const Vec4 halves = hn::SwapAdjacentBlocks(v);
    return {hn::Reverse2(wide, v), hn::DupEven(halves), hn::DupOdd(halves)};
}

/// The signed volumes of `tetrahedron_weights`: b·(c×d), −a·(c×d), d·(a×b), −c·(a×b).
HWY_INLINE Vec4 signed_volumes(const Corners& corners) {
    const Shuffled x = shuffle(corners.x);
    const Shuffled y = shuffle(corners.y);
    const Shuffled z = shuffle(corners.z);
    const Vec4 cross_x = hn::Sub(hn::Mul(y.first, z.second), hn::Mul(y.second, z.first));
    const Vec4 cross_y = hn::Sub(hn::Mul(z.first, x.second), hn::Mul(z.second, x.first));
    const Vec4 cross_z = hn::Sub(hn::Mul(x.first, y.second), hn::Mul(x.second, y.first));
    const Vec4 dot = hn::Add(hn::Add(hn::Mul(x.swapped, cross_x), hn::Mul(y.swapped, cross_y)),
                             hn::Mul(z.swapped, cross_z));
    return hn::OddEven(hn::Neg(dot), dot);
}

/// Combines the lanes two by two; the result is in all lanes.
template <class Op>
HWY_INLINE Vec4 across(Vec4 v, Op op) {
    const Double4 wide;
    const Vec4 halves = op(v, hn::SwapAdjacentBlocks(v));
    return op(halves, hn::Reverse2(wide, halves));
}

/// The walks of one stream, one test a step. Whether a test finds the query or sends it on is a
/// coin toss that no processor predicts, so both are done and the results selected: a branch would
/// throw away what the other streams have begun.
class StreamWalk {
  public:
    HWY_INLINE StreamWalk(const ProbeVolumeView& volume, QueryBlock& block, size_t stream)
        : block_(block),
          starts_(&block.start[QueryBlock::start_index(0, stream)]),
          cells_(volume.cells.data()),
          positions_(&volume.positions.data()->x),
          probe_count_(static_cast<uint32_t>(volume.positions.size())),
          inner_count_(volume.info.inner_cell_count),
          query_(stream * QueryBlock::kStreamSize),
          end_(query_ + block.count[stream]),
          cell_(start_or(block.cell[stream])) {}

    [[nodiscard]] HWY_INLINE bool is_done() const { return query_ == end_; }

    [[nodiscard]] HWY_INLINE uint32_t cell() const { return cell_; }

    /// Tests one cell. Precondition: not done.
    HWY_INLINE void step() {
        const Double4 wide;
        const Cell& cell = cells_[cell_];
        ++test_count_;
        if (HWY_UNLIKELY(!has_good_vertices(cell))) return leave_open(cell_);
        const Corners corners =
            load_corners(positions_, cell, hn::Set(wide, block_.x[query_]),
                         hn::Set(wide, block_.y[query_]), hn::Set(wide, block_.z[query_]));
        const Vec4 volumes = signed_volumes(corners);
        const Vec4 smallest = across(volumes, [](Vec4 a, Vec4 b) { return hn::Min(a, b); });
        const bool is_inside = (hn::GetLane(smallest) >= 0.0) & write_location(corners, volumes);
        const intptr_t face = hn::FindFirstTrue(wide, hn::Eq(volumes, smallest));
        const uint32_t next = cell.neighbors[static_cast<size_t>(face) & 3];
        // All ones inside: selects without a branch, which compilers do not take from `? :`.
        const uint32_t inside = 0u - static_cast<uint32_t>(is_inside);
        steps_ = (steps_ + 1) & ~inside;
        const bool is_odd = (next == previous_) | (steps_ == kWalkLimit) | (face < 0);
        const bool is_beyond = next >= inner_count_;
        if (HWY_UNLIKELY((is_odd | is_beyond) & !is_inside)) {
            return leave_open(is_odd ? cell_ : next);
        }
        query_ += inside & 1;
        previous_ = inside | cell_;
        const uint32_t start = start_or(cell_);
        cell_ = (start & inside) | (next & ~inside);
        hwy::Prefetch(&cells_[cell_]);
    }

    /// Asks for the corners that `step` reads: those of all streams come at once.
    HWY_INLINE void fetch_corners() const {
        for (const uint32_t probe : cells_[cell_].vertices) {
            hwy::Prefetch(positions_ + 3 * size_t{probe});
        }
    }

    void finish() const { block_.step_count += test_count_; }

  private:
    [[nodiscard]] HWY_INLINE bool has_good_vertices(const Cell& cell) const {
        return (cell.vertices[0] < probe_count_) & (cell.vertices[1] < probe_count_) &
               (cell.vertices[2] < probe_count_) & (cell.vertices[3] < probe_count_);
    }

    /// Where the walk of the present query begins.
    [[nodiscard]] HWY_INLINE uint32_t start_or(uint32_t cell) const {
        const uint32_t start = starts_[query_];
        const uint32_t is_none = 0u - static_cast<uint32_t>(start == kNoIndex);
        return (cell & is_none) | (start & ~is_none);
    }

    /// Writes where the query is if it is in this cell. False: the cell is a sliver that holds no
    /// position.
    HWY_INLINE bool write_location(const Corners& corners, Vec4 volumes) {
        const Double4 wide;
        const hn::FixedTag<float, 4> narrow;
        const Vec4 sum = across(volumes, [](Vec4 a, Vec4 b) { return hn::Add(a, b); });
        const Vec4 weights = hn::Add(hn::Div(volumes, sum), hn::Zero(wide));
        CellLocation& location = block_.location[query_];
        location.cell = cell_;
        location.ambient = 0.0f;
        hn::StoreU(hn::DemoteTo(narrow, weights), narrow, &location.weights.x);

        const Vec4 squares =
            hn::Add(hn::Add(hn::Mul(corners.x, corners.x), hn::Mul(corners.y, corners.y)),
                    hn::Mul(corners.z, corners.z));
        const double square =
            hn::GetLane(across(squares, [](Vec4 a, Vec4 b) { return hn::Max(a, b); }));
        const double total = hn::GetLane(sum);
        return (total > 0.0) & (total * total > kSliverRounding * (square * square * square));
    }

    HWY_INLINE void leave_open(uint32_t cell) {
        block_.open[block_.open_count] = static_cast<uint32_t>(query_);
        block_.open_cell[block_.open_count++] = cell;
        ++query_;
        previous_ = kNoIndex;
        steps_ = 0;
        cell_ = start_or(cell_);
    }

    QueryBlock& block_;
    const uint32_t* starts_;
    const Cell* cells_;
    const float* positions_;
    uint32_t probe_count_;
    uint32_t inner_count_;
    size_t query_;
    size_t end_;
    uint32_t cell_;
    uint32_t previous_ = kNoIndex;
    uint32_t steps_ = 0;
    uint64_t test_count_ = 0;
};

void walk_tetrahedra(const ProbeVolumeView& volume, QueryBlock& block) {
    StreamWalk a(volume, block, 0);
    StreamWalk b(volume, block, 1);
    StreamWalk c(volume, block, 2);
    StreamWalk d(volume, block, 3);
    while (!a.is_done() && !b.is_done() && !c.is_done() && !d.is_done()) {
        a.fetch_corners();
        b.fetch_corners();
        c.fetch_corners();
        d.fetch_corners();
        a.step();
        b.step();
        c.step();
        d.step();
    }
    while (!a.is_done()) a.step();
    while (!b.is_done()) b.step();
    while (!c.is_done()) c.step();
    while (!d.is_done()) d.step();
    for (const StreamWalk* walk : {&a, &b, &c, &d}) walk->finish();
    block.cell = {a.cell(), b.cell(), c.cell(), d.cell()};
}

#else

void walk_tetrahedra(const ProbeVolumeView& volume, QueryBlock& block) {
    scalar_kernels().walk_tetrahedra(volume, block);
}

#endif

using Doubles = hn::CappedTag<double, HullLanes::kCount>;
using VecD = hn::Vec<Doubles>;

/// Vectors in three registers.
struct Vec3 {
    VecD x, y, z;
};

HWY_INLINE Vec3 load3(const std::array<HullLanes::Lanes<double>, 3>& from, size_t lane) {
    const Doubles d;
    return {hn::Load(d, &from[0][lane]), hn::Load(d, &from[1][lane]), hn::Load(d, &from[2][lane])};
}

HWY_INLINE Vec3 subtract(const Vec3& a, const Vec3& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

HWY_INLINE Vec3 add(const Vec3& a, const Vec3& b) {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}

HWY_INLINE Vec3 scale(const Vec3& a, VecD factor) {
    return {hn::Mul(a.x, factor), hn::Mul(a.y, factor), hn::Mul(a.z, factor)};
}

HWY_INLINE Vec3 cross(const Vec3& a, const Vec3& b) {
    return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(b.y, a.z)),
            hn::Sub(hn::Mul(a.z, b.x), hn::Mul(b.z, a.x)),
            hn::Sub(hn::Mul(a.x, b.y), hn::Mul(b.x, a.y))};
}

HWY_INLINE VecD dot(const Vec3& a, const Vec3& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

/// The cubics of `hull_cell_weights` in the lanes.
struct Cubics {
    VecD c0, c1, c2, c3;
};

HWY_INLINE Cubics plane_cubics(const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& v) {
    const Vec3 a = subtract(p[0], p[2]), da = subtract(v[0], v[2]);
    const Vec3 b = subtract(p[1], p[2]), db = subtract(v[1], v[2]);
    const Vec3 d{hn::Neg(p[2].x), hn::Neg(p[2].y), hn::Neg(p[2].z)};
    const Vec3 n0 = cross(a, b);
    const Vec3 n1 = add(cross(a, db), cross(da, b));
    const Vec3 n2 = cross(da, db);
    return {dot(n0, d), hn::Sub(dot(n1, d), dot(n0, v[2])), hn::Sub(dot(n2, d), dot(n1, v[2])),
            hn::Neg(dot(n2, v[2]))};
}

/// `root_of_falling` in each lane of `is_falling`; what the others hold has no meaning.
HWY_INLINE VecD roots_of_falling(const Cubics& c, hn::Mask<Doubles> is_falling) {
    const Doubles d;
    const VecD root =
        hn::Sqrt(hn::Sub(hn::Mul(c.c1, c.c1), hn::Mul(hn::Mul(hn::Set(d, 4.0), c.c2), c.c0)));
    VecD t = hn::Div(hn::Mul(hn::Set(d, 2.0), c.c0), hn::Sub(root, c.c1));
    auto is_active = is_falling;
    for (int step = 0; step < 100 && !hn::AllFalse(d, is_active); ++step) {
        const VecD value =
            hn::Add(hn::Mul(hn::Add(hn::Mul(hn::Add(hn::Mul(c.c3, t), c.c2), t), c.c1), t), c.c0);
        const VecD slope = hn::Add(hn::Mul(hn::Add(hn::Mul(hn::Mul(hn::Set(d, 3.0), c.c3), t),
                                                   hn::Mul(hn::Set(d, 2.0), c.c2)),
                                           t),
                                   c.c1);
        const VecD next = hn::Sub(t, hn::Div(value, slope));
        const auto goes_on = hn::Lt(next, hn::Mul(t, hn::Set(d, 1 - 1e-8)));
        t = hn::IfThenElse(is_active, next, t);
        is_active = hn::And(is_active, goes_on);
    }
    return t;
}

/// `hull_cell_weights` of the lanes from `lane` on, where its cubic falls.
HWY_INLINE void hull_weights_from(HullLanes& lanes, size_t lane) {
    const Doubles d;
    const VecD zero = hn::Zero(d);
    std::array<Vec3, 3> p{load3(lanes.corners[0], lane), load3(lanes.corners[1], lane),
                          load3(lanes.corners[2], lane)};
    const std::array<Vec3, 3> v{load3(lanes.rays[0], lane), load3(lanes.rays[1], lane),
                                load3(lanes.rays[2], lane)};
    const VecD square = hn::Max(hn::Max(dot(p[0], p[0]), dot(p[1], p[1])), dot(p[2], p[2]));
    const VecD unit = hn::Div(hn::Set(d, 1.0), hn::Sqrt(square));
    for (Vec3& corner : p) corner = scale(corner, unit);
    const Cubics c = plane_cubics(p, v);
    const auto is_falling = hn::And(hn::And(hn::Gt(c.c0, zero), hn::Lt(c.c1, zero)),
                                    hn::And(hn::Le(c.c2, zero), hn::Le(c.c3, zero)));
    const VecD t = roots_of_falling(c, is_falling);
    for (size_t i = 0; i < 3; ++i) p[i] = add(p[i], scale(v[i], t));

    const Vec3 first = subtract(p[1], p[0]);
    const Vec3 second = subtract(p[2], p[0]);
    const Vec3 normal = cross(first, second);
    const VecD area = dot(normal, normal);
    const VecD longest = hn::Max(dot(first, first), dot(second, second));
    const VecD per_area = hn::Div(hn::Set(d, 1.0), area);
    const VecD w0 = hn::Mul(dot(cross(p[1], p[2]), normal), per_area);
    const VecD w1 = hn::Mul(dot(cross(p[2], p[0]), normal), per_area);
    hn::Store(w0, d, &lanes.weights[0][lane]);
    hn::Store(w1, d, &lanes.weights[1][lane]);
    hn::Store(hn::Sub(hn::Sub(hn::Set(d, 1.0), w0), w1), d, &lanes.weights[2][lane]);
    const auto is_known =
        hn::And(hn::And(is_falling, hn::Le(t, hn::Set(d, kFarthestRoot))),
                hn::Gt(area, hn::Mul(hn::Mul(hn::Set(d, kFlatTriangle), longest), longest)));
    alignas(64) double known[HullLanes::kCount];
    hn::Store(hn::IfThenElse(is_known, hn::Set(d, 1.0), zero), d, known);
    for (size_t i = 0; i < hn::Lanes(d); ++i) lanes.is_known[lane + i] = known[i] != 0.0;
}

void hull_weights(HullLanes& lanes) {
    for (size_t lane = 0; lane < HullLanes::kCount; lane += hn::Lanes(Doubles())) {
        hull_weights_from(lanes, lane);
    }
}

/// The floats of an answer, in the order of a compact probe: irradiance, occlusion, validity.
struct alignas(64) Values {
    std::array<float, 32> floats{};

    [[nodiscard]] float* irradiance() { return floats.data(); }

    [[nodiscard]] float* occlusion() { return floats.data() + 27; }
};

/// Σ w_i p_i over four arrays of `kCount` floats. The last vector overlaps the one before it.
template <size_t kCount>
HWY_INLINE void blend_floats(const std::array<const float*, 4>& from, const float* weights,
                             float* to) {
    const hn::CappedTag<float, (kCount < 8 ? 4 : 8)> lanes;
    const size_t step = hn::Lanes(lanes);
    for (size_t k = 0; k < kCount; k += step) {
        const size_t at = k + step <= kCount ? k : kCount - step;
        auto sum = hn::Mul(hn::Set(lanes, weights[0]), hn::LoadU(lanes, from[0] + at));
        for (size_t i = 1; i < 4; ++i) {
            sum = hn::Add(sum, hn::Mul(hn::Set(lanes, weights[i]), hn::LoadU(lanes, from[i] + at)));
        }
        hn::StoreU(sum, lanes, to + at);
    }
}

/// The same over compact probes, all 32 halves in one go.
HWY_INLINE void blend_halves(const std::array<const CompactProbe*, 4>& from, const float* weights,
                             const Values& scales, float* to) {
    const hn::CappedTag<float, 16> lanes;
    const hn::Rebind<hwy::float16_t, decltype(lanes)> halves;
    const size_t step = hn::Lanes(lanes);
    for (size_t k = 0; k < 32; k += step) {
        const auto weighted = [&](size_t i) HWY_ATTR {
            const auto* probe = reinterpret_cast<const hwy::float16_t*>(from[i]);
            return hn::Mul(hn::Set(lanes, weights[i]),
                           hn::PromoteTo(lanes, hn::LoadU(halves, probe + k)));
        };
        auto sum = weighted(0);
        for (size_t i = 1; i < 4; ++i) sum = hn::Add(sum, weighted(i));
        hn::StoreU(hn::Mul(sum, hn::LoadU(lanes, scales.floats.data() + k)), lanes, to + k);
    }
}

/// Blends and writes the answers of located queries, whose cells exist.
class Blender {
  public:
    Blender(const ProbeVolumeView& volume, const BlendTarget& target)
        : volume_(volume),
          target_(target),
          is_compact_(volume.compact.size() == volume.positions.size()),
          has_floats_(volume.irradiance.size() == volume.positions.size()),
          has_occlusion_(volume.occlusion.size() == volume.positions.size()) {
        scales_.floats.fill(1.0f);
        std::fill_n(scales_.irradiance(), 27, volume.info.compact_scale);
    }

    /// Whether this code knows the volume's kind; else the scalar twin does.
    [[nodiscard]] bool is_able() const { return is_compact_ || has_floats_; }

    HWY_INLINE void prefetch(const CellLocation& location) const {
        if (location.cell >= volume_.cells.size()) return;
        for (const uint32_t probe : volume_.cells[location.cell].vertices) {
            if (probe >= volume_.positions.size()) continue;
            if (is_compact_) {
                hwy::Prefetch(&volume_.compact[probe]);
            } else {
                hwy::Prefetch(&volume_.irradiance[probe]);
                hwy::Prefetch(&volume_.irradiance[probe].coefficients[6]);
            }
        }
    }

    HWY_INLINE void write(const CellLocation& location, size_t answer) const {
        Values values;
        blend(location, values);
        if (HWY_UNLIKELY(location.ambient > 0.0f)) add_ambient(location.ambient, values);
        if (!target_.irradiance.memory.empty()) {
            write_irradiance(target_.irradiance, answer, values.irradiance());
        }
        if (!target_.occlusion.memory.empty()) {
            write_values<4>(target_.occlusion, answer, values.occlusion());
        }
    }

  private:
    HWY_INLINE void blend(const CellLocation& location, Values& values) const {
        const Cell& cell = volume_.cells[location.cell];
        const std::array<uint32_t, 4> probes{
            vertex_at(volume_, cell, 0), vertex_at(volume_, cell, 1), vertex_at(volume_, cell, 2),
            vertex_at(volume_, cell, 3)};
        const float* weights = &location.weights.x;
        if (is_compact_) {
            const CompactProbe* first = volume_.compact.data();
            return blend_halves(
                {first + probes[0], first + probes[1], first + probes[2], first + probes[3]},
                weights, scales_, values.irradiance());
        }
        const auto irradiance = [&](size_t i) {
            return &volume_.irradiance[probes[i]].coefficients[0].x;
        };
        blend_floats<27>({irradiance(0), irradiance(1), irradiance(2), irradiance(3)}, weights,
                         values.irradiance());
        if (!has_occlusion_) {
            std::fill_n(values.occlusion(), 4, 1.0f - location.ambient);
        } else if (!target_.occlusion.memory.empty()) {
            const auto occlusion = [&](size_t i) { return &volume_.occlusion[probes[i]].x; };
            blend_floats<4>({occlusion(0), occlusion(1), occlusion(2), occlusion(3)}, weights,
                            values.occlusion());
        }
    }

    void add_ambient(float share, Values& values) const {
        const float* ambient = &volume_.info.ambient.coefficients[0].x;
        for (int k = 0; k < 27; ++k) values.irradiance()[k] += share * ambient[k];
        for (int k = 0; k < 4; ++k) values.occlusion()[k] += share;
    }

    const ProbeVolumeView& volume_;
    const BlendTarget& target_;
    bool is_compact_;
    bool has_floats_;
    bool has_occlusion_;
    Values scales_;
};

void blend(const ProbeVolumeView& volume, std::span<const CellLocation> locations,
           const BlendTarget& target) {
    const Blender blender(volume, target);
    if (!blender.is_able()) return scalar_kernels().blend(volume, locations, target);
    constexpr size_t kAhead = 8;
    for (size_t i = 0; i < std::min(kAhead, locations.size()); ++i) blender.prefetch(locations[i]);
    for (size_t i = 0; i < locations.size(); ++i) {
        if (i + kAhead < locations.size()) blender.prefetch(locations[i + kAhead]);
        if (HWY_UNLIKELY(locations[i].cell >= volume.cells.size())) {
            scalar_kernels().blend(
                volume, locations.subspan(i, 1),
                {target.answers.subspan(i, 1), target.irradiance, target.occlusion});
        } else {
            blender.write(locations[i], target.answers[i]);
        }
    }
}

}  // namespace tetralight::detail::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace tetralight::detail {
namespace {

HWY_EXPORT(walk_tetrahedra);
HWY_EXPORT(hull_weights);
HWY_EXPORT(blend);

void walk_fastest(const ProbeVolumeView& volume, QueryBlock& block) {
    HWY_DYNAMIC_DISPATCH(walk_tetrahedra)(volume, block);
}

void hull_weights_fastest(HullLanes& lanes) {
    HWY_DYNAMIC_DISPATCH(hull_weights)(lanes);
}

void blend_fastest(const ProbeVolumeView& volume, std::span<const CellLocation> locations,
                   const BlendTarget& target) {
    HWY_DYNAMIC_DISPATCH(blend)(volume, locations, target);
}

}  // namespace

const QueryKernels& query_kernels() noexcept {
    static constexpr QueryKernels kKernels{walk_fastest, hull_weights_fastest, blend_fastest};
    return kKernels;
}

}  // namespace tetralight::detail

#endif
